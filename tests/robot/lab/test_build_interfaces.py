"""Building the interfaces of a notebook."""

from __future__ import annotations

import pytest
from kernels import CellError, Kernel

WRITE = """
from pathlib import Path
Path("my_interfaces").mkdir(exist_ok=True)
Path("my_interfaces/Level.msg").write_text({text!r})
Path("says_level.py").write_text('''
import rclpy
from my_interfaces.msg import Level
rclpy.init()
node = rclpy.create_node("says_level")
level = node.create_publisher(Level, "level", 10)
node.create_timer(0.1, lambda: level.publish(Level(percentage=0.5)))
rclpy.spin(node)
''')
"""


def test_nodes_and_the_notebook_share_the_last_build_until_the_notebook_has_imported_it(
    kernel: Kernel,
) -> None:
    kernel.run(WRITE.format(text="string level\n"))
    kernel.run("lab.build_interfaces('my_interfaces')", 600)
    kernel.run(WRITE.format(text="float32 percentage\n"))
    assert "my_interfaces/msg/Level: built (" in kernel.run("lab.build_interfaces('my_interfaces')", 600)
    received = kernel.run("""
from my_interfaces.msg import Level
lab.run_node("says_level.py")
received = []
subscription = lab.node().create_subscription(Level, "level", received.append, 10)
lab.wait_until(lambda: received)
print(received[0])
lab.node().destroy_subscription(subscription)
lab.stop_nodes()""")
    assert received == "my_interfaces.msg.Level(percentage=0.5)\n"

    again = kernel.run("lab.build_interfaces('my_interfaces')")
    assert "my_interfaces/msg/Level: unchanged (" in again
    assert "restart the kernel" not in again

    kernel.run("Path('my_interfaces/Level.msg').write_text('float64 percentage')")
    assert "imported an earlier version of my_interfaces and still uses it" in kernel.run(
        "lab.build_interfaces('my_interfaces')", 600
    )
    assert kernel.run("print(Level.get_fields_and_field_types())") == "{'percentage': 'float'}\n"


def test_a_wrong_definition_is_named_with_its_line(kernel: Kernel) -> None:
    kernel.run(
        "from pathlib import Path\nPath('bad_interfaces/msg').mkdir(parents=True)\n"
        "Path('bad_interfaces/msg/Level.msg').write_text('# 0..1\\nfloat level')"
    )
    with pytest.raises(
        CellError, match=r"bad_interfaces was not built\.\nmsg/Level\.msg, line 2: float level\n"
    ):
        kernel.run("lab.build_interfaces('bad_interfaces')")
    with pytest.raises(
        CellError, match=r"bad_interfaces was not written\.\nmsg/Level\.msg, line 2: float level\n"
    ):
        kernel.run("lab.export_package('bad_interfaces', 'ros2_ws')")


def test_a_missing_folder_is_named(kernel: Kernel) -> None:
    with pytest.raises(CellError, match=r"no folder gone_interfaces .* run the cells that write its files"):
        kernel.run("lab.build_interfaces('gone_interfaces')")


def test_an_import_before_the_build_does_not_spoil_the_one_after_it(kernel: Kernel) -> None:
    kernel.run(
        "from pathlib import Path\nPath('early_interfaces/msg').mkdir(parents=True)\n"
        "Path('early_interfaces/msg/Level.msg').write_text('float32 percentage')"
    )
    with pytest.raises(CellError, match="cannot import name 'Level'"):
        kernel.run("from early_interfaces.msg import Level")
    kernel.run("lab.build_interfaces('early_interfaces')", 600)
    assert kernel.run("from early_interfaces.msg import Level\nprint(Level())").startswith("early_interfaces")
