"""How much an arena and a student's process may use. MiB and KiB are powers of two, seconds are wall time."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ArenaLimits:
    """What the controller grants to everything inside one arena together."""

    deadline_s: float = 120.0
    memory_mib: int = (
        1536  # resident memory of all processes, watched by polling; twice as much is never borne
    )
    memory_grace_s: float = (
        1.0  # above it, in which the agent on a busy machine can still end a student's bomb
    )
    output_kib: int = 256  # kept of stdout and of stderr each
    tmp_mib: int = 64
    shared_memory_mib: int = 64

    @property
    def most_memory_mib(self) -> int:
        """What is never borne, not for a moment: twice the resident memory, and the files in memory."""
        return 2 * self.memory_mib + self.tmp_mib + self.shared_memory_mib


@dataclass(frozen=True)
class StudentLimits:
    """What the arena grants to the student's process and everything it starts.

    A node of rclpy has 12-16 threads and 590-850 MiB of address space, of which 65 MiB are resident.
    """

    processes: int = 64  # threads count too
    memory_mib: int = 700  # resident memory of all its processes, enforced by arena/student_limits_monitor.py
    open_files: int = 256  # a process
    file_mib: int = 16  # a file
    address_space_mib: int = 4096  # a process
    tmp_mib: int = 32  # its folder and everything else under /tmp
    shared_memory_mib: int = 16
    # The kernel has no limit for these; enforced by arena/student_limits_monitor.py.
    files: int = 10_000  # and folders and links, which take memory although they are empty
    sockets: int = 700  # with the arena's, about 60; in a shared network only its own
    tcp_sockets: int = 64  # of these; each may hold megabytes, and ROS has none
    output_kib: int = 256  # kept of stdout and of stderr each
