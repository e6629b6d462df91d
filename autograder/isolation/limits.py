"""How much an arena and a student's process may use. MiB and KiB are powers of two, seconds are wall time."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ArenaLimits:
    """Limits of all processes in one arena together, enforced by the controller."""

    deadline_s: float = 120.0
    # resident memory of all processes, sampled; more is tolerated for the grace time only
    memory_mib: int = 1536
    memory_grace_s: float = 1.0  # above memory_mib, so that the agent can end the student's processes first
    output_kib: int = 256  # kept of stdout and of stderr each
    tmp_mib: int = 64
    shared_memory_mib: int = 64

    @property
    def most_memory_mib(self) -> int:
        """The hard limit, without grace: twice `memory_mib`, plus the in-memory file systems."""
        return 2 * self.memory_mib + self.tmp_mib + self.shared_memory_mib


@dataclass(frozen=True)
class StudentLimits:
    """Limits of the student's process and all processes that it starts, enforced by the arena.

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
    files: int = 10_000  # files, folders and links: even empty ones take memory
    sockets: int = 700  # including about 60 of the arena; in a shared network the program's alone
    tcp_sockets: int = 64  # among the sockets; one can buffer megabytes, and ROS needs none
    output_kib: int = 256  # kept of stdout and of stderr each
