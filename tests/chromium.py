"""The tests' browser: without access to the network, and able to draw in 3D without a graphics card."""

import shutil

import pytest

CHROMIUM = shutil.which("chromium")
OFFLINE = ("--no-sandbox", "--disable-quic", "--disable-background-networking", "--disable-component-update")
DRAWING = (*OFFLINE, "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")  # WebGL

needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="there is no chromium to look with")
