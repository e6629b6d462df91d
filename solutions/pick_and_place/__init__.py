"""An action server that takes an object from the table and puts it down elsewhere."""
