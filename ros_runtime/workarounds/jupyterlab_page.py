"""Run a script in the page of JupyterLab that shows a notebook; it may only use what a user could click."""

from __future__ import annotations

from string import Template

# What the button with the disk does, which then takes the focus.
_SAVE = """{
const focused = document.activeElement;
document.querySelector('.jp-NotebookPanel:not(.lm-mod-hidden) [data-command="docmanager:save"]')?.click();
setTimeout(() => focused.focus({preventScroll: true}));
}"""
# A side bar closes a tab only if both events of the pointer lie on the cross of the tab.
_CLOSE = Template("""
const old = [...document.querySelectorAll('.jp-SideBar.jp-mod-right .lm-TabBar-tab')].find(
    tab => tab.innerText.trim() === '$title' && !document.getElementById(tab.dataset.id)?.querySelector('.$kept'))
const cross = old?.querySelector('.lm-TabBar-tabCloseIcon')
if (cross) {
    const {x, y, width, height} = cross.getBoundingClientRect()
    const at = {bubbles: true, clientX: x + width / 2, clientY: y + height / 2}
    for (const kind of ['pointerdown', 'pointerup']) cross.dispatchEvent(new PointerEvent(kind, at))
}""")


def save_notebook() -> None:
    """Have JupyterLab save the notebook that is shown, while its cell runs on."""
    _run(_SAVE)


def close_old_panel(title: str, *, kept: str) -> None:
    """Close a panel of the right side bar that an ended kernel has left behind.

    A panel with an element of the class `kept` stays open.
    """
    _run(_CLOSE.substitute(title=title, kept=kept))


def _run(script: str) -> None:
    """Run a script in the page; other editors ignore it."""
    from IPython.display import Javascript, display  # not needed in a terminal

    shown = display(Javascript(script), display_id=True)
    if shown is not None:
        # the script must not stay in the notebook, because it would run again when the notebook is opened
        shown.update({"text/plain": ""}, raw=True)
