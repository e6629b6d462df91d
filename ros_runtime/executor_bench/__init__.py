"""Does a sound MultiThreadedExecutor server keep its pace? `python -m ros_runtime.executor_bench --help`."""
