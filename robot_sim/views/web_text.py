"""Lines of text over MuJoCo's web viewer, at the lower left; imported only if there is a viewer."""

from __future__ import annotations

from collections.abc import Sequence

from mujoco.studio import messages, plugin
from mujoco.studio.dear_imgui import dear_imgui as imgui

MARGIN = 8.0  # px from the edges
BACKGROUND = "#16181d"  # the same in the viewer's light and dark themes, because the text's colours are fixed
OPACITY = 0.8  # of the background


class WebText(plugin.ViewerPlugin):
    """Text in a window without input. The caller sets `lines`; the viewer's thread draws them."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: Sequence[tuple[str, str]] = ()  # text and its colour, #rrggbb

    @messages.handler
    def build_gui(self, _event: messages.BuildGuiEvent) -> None:
        """Draw the present lines."""
        lines = self.lines
        if not lines:
            return
        corner = imgui.Vec2(MARGIN, imgui.GetIO().DisplaySize.y - MARGIN)
        imgui.SetNextWindowPos(corner, 0, imgui.Vec2(0.0, 1.0))  # of its own lower left corner
        imgui.SetNextWindowBgAlpha(OPACITY)
        imgui.PushStyleColor(int(imgui.Col.WindowBg), _rgba(BACKGROUND))
        flags = imgui.WindowFlags
        imgui.Begin("text", flags=int(flags.NoDecoration) | int(flags.NoInputs) | int(flags.AlwaysAutoResize))
        for text, colour in lines:
            imgui.TextColored(_rgba(colour), text)
        imgui.End()
        imgui.PopStyleColor()


def _rgba(colour: str) -> imgui.Vec4:
    red, green, blue = (int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5))
    return imgui.Vec4(red, green, blue, 1.0)
