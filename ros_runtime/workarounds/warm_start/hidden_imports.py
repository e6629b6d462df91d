"""Hides loaded modules until a program imports them; the import then takes microseconds.

    with Recording() as recording:
        import rclpy.node
    hide(recording, before)           # `before`: the names in sys.modules at the start of this process
    import rclpy                      # takes microseconds, and shows the modules that rclpy itself imports

A program that forgets an import fails as in a fresh interpreter: a hidden module is neither in sys.modules nor an
attribute of its package until the program imports it, directly or through another module.
"""

from __future__ import annotations

# Only modules that a fresh interpreter has loaded anyway: imports before the recording are not recorded.
import builtins
import importlib
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from importlib.machinery import ModuleSpec
    from types import FrameType, ModuleType, TracebackType
    from typing import Any

    Imports = dict[str, dict[str, None]]  # by module: what its own code imports, in order


class Recording:
    """Records, for each module, which modules it imports while it is loaded."""

    def __init__(self) -> None:
        self.imports: Imports = {}

    def __enter__(self) -> Recording:
        self._import, self._import_module = builtins.__import__, importlib.import_module
        builtins.__import__ = self._on_import
        importlib.import_module = self._on_import_module
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        builtins.__import__, importlib.import_module = self._import, self._import_module

    def _on_import(
        self,
        name: str,
        globals: Mapping[str, Any] | None = None,
        locals: Mapping[str, Any] | None = None,
        fromlist: Sequence[str] | None = (),
        level: int = 0,
    ) -> ModuleType:
        module = self._import(name, globals, locals, fromlist or (), level)
        full_name = _full_name(name, globals or {}, level)
        self._note(full_name)
        for item in _submodules(full_name, fromlist or ()):
            self._note(item)
        return module

    def _on_import_module(self, name: str, package: str | None = None) -> ModuleType:
        module = self._import_module(name, package)
        level = len(name) - len(name.lstrip("."))
        self._note(_full_name(name[level:], {"__package__": package}, level))
        return module

    def _note(self, imported: str) -> None:
        """Record an import under its importer: the module whose top-level code is innermost on the stack."""
        frame: FrameType | None = sys._getframe(2)
        while frame and frame.f_code.co_name != "<module>":
            frame = frame.f_back
        importer = frame.f_globals.get("__name__") if frame else None
        if importer and importer != imported:
            self.imports.setdefault(importer, {})[imported] = None


def hide(recording: Recording, before: Iterable[str]) -> None:
    """Hide every module that was loaded since `before` (names of modules)."""
    shown = set(before)
    hidden = {
        name: module
        for name, module in sys.modules.items()
        if name not in shown and _is_imported_as(name, module)
    }
    for name, module in hidden.items():
        del sys.modules[name]
        package, _, last = name.rpartition(".")
        parent = hidden.get(package) or sys.modules.get(package)
        if parent is not None and vars(parent).get(last) is module:
            delattr(parent, last)
    sys.meta_path.insert(0, _Finder(hidden, recording.imports))


class _Finder:
    """Finder and loader of hidden modules: imports their recorded imports, then restores their contents."""

    def __init__(self, hidden: dict[str, ModuleType], imports: Imports) -> None:
        self._hidden = hidden
        self._imports = imports
        self._contents = {name: dict(vars(module)) for name, module in hidden.items()}
        self._loaders: dict[str, Any] = {}

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        module = self._hidden.get(name)
        if module is None or module.__spec__ is None:
            return None
        self._loaders[name] = module.__spec__.loader
        module.__spec__.loader = self  # type: ignore[assignment]
        return module.__spec__

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        return self._hidden.pop(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        assert module.__spec__ is not None
        name = module.__spec__.name
        module.__spec__.loader = self._loaders.pop(name)
        for imported in self._imports.get(name, ()):
            importlib.import_module(imported)
        # restore names that the package had rebound after importing a submodule of the same name
        vars(module).update(self._contents.pop(name))


def _is_imported_as(name: str, module: Any) -> bool:
    """Return whether a module was imported under this name, not added to sys.modules by code, as os.path is."""
    spec = vars(module).get("__spec__") if isinstance(module, type(sys)) else None
    return spec is not None and spec.name == name


def _full_name(name: str, importer: Mapping[str, Any], level: int) -> str:
    """Return the absolute name of what `from ..name import` imports."""
    if level == 0:
        return name
    package = importer.get("__package__")
    if not package:
        package = importer["__name__"] if "__path__" in importer else importer["__name__"].rpartition(".")[0]
    base = package.rsplit(".", level - 1)[0]
    return f"{base}.{name}" if name else base


def _submodules(package: str, fromlist: Sequence[str]) -> list[str]:
    """Return which of the names imported from a package are modules."""
    names = list(fromlist)
    if "*" in names:
        names += getattr(sys.modules.get(package), "__all__", ())
    return [f"{package}.{name}" for name in names if f"{package}.{name}" in sys.modules]
