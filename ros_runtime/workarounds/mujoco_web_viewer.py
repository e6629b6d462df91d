"""Start MuJoCo's web viewer on the loopback interface only.

The viewer has no password, listens on every interface, and has no option to change that.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Future
from contextlib import contextmanager
from socket import socket
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco
    from mujoco.studio.viewer_handle import ViewerHandle

LOOPBACK = "127.0.0.1"
START_TIMEOUT = 30.0  # s


def launch_web_viewer(
    port: int, camera: mujoco.MjvCamera, plugins: Sequence[Any] = ()
) -> tuple[ViewerHandle, int]:
    """Start the viewer in a thread of this process.

    Args:
        port: where to listen; 0 takes the first free one from 8080 on.
        camera: the initial camera.
        plugins: of `mujoco.studio.plugin`, which draw over the picture.

    Returns:
        The handle of the viewer, and the port it listens on.

    Raises:
        OSError: the port is taken.
        ImportError: this MuJoCo is older than 4.0 and has no web viewer.
    """
    # Imported late: this takes half a second, and a robot without a view does not need it.
    from mujoco.studio import launch_thread, viewer_protocol, web_viewer

    # Its banner shows addresses that it is not bound to. Its other output would mix with this process's lines, because
    # another thread prints it.
    web_viewer.print = lambda *_arguments, **_options: None

    config = viewer_protocol.ViewerConfig(title="robot", gfx="web", http_port=port)
    started: Future[int] = Future()

    def serve(endpoint: Any) -> None:
        try:
            with _bound_to_loopback() as ports:
                viewer = web_viewer.WebViewer(config, endpoint, camera=camera, plugins=[*plugins])
        except BaseException as error:
            started.set_exception(error)
            raise
        started.set_result(ports[0])
        viewer_protocol.run_viewer_loop(viewer)

    return launch_thread.launch_thread(serve), started.result(START_TIMEOUT)


@contextmanager
def _bound_to_loopback() -> Iterator[list[int]]:
    """Make a viewer that starts in the `with` block bind to loopback; append its port to the yielded list."""
    from mujoco.studio.web import web_server

    bind = web_server.bind_public_socket
    ports: list[int] = []

    def bind_to_loopback(_host: str, wanted: int = 0) -> socket:
        try:
            bound = bind(LOOPBACK, wanted)
        except RuntimeError as error:  # MuJoCo raises this if the port is taken
            raise OSError(str(error)) from error
        ports.append(bound.getsockname()[1])
        return bound

    web_server.bind_public_socket = bind_to_loopback
    try:
        yield ports
    finally:
        web_server.bind_public_socket = bind
