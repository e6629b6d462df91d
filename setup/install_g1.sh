#!/usr/bin/env bash
# Installs the extra `g1` of pyproject.toml, 65 MB, after ./course has made the environment. Only uv, and only in the
# folder of pyproject.toml, reads there that two of the packages are to be taken without their dependencies.
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd) || exit 1
python=$root/.venv/bin/python
exec "$python" -m uv --directory "$root" pip install --quiet --python "$python" --constraints .venv/constraints.txt \
    --requirements pyproject.toml --extra g1
