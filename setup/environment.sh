# Sourced by ./course when .venv is missing or stale: makes or updates the environment.
#
# The stamp is written last, so an interrupted set-up is repeated from the start. Only one set-up at a
# time runs in a clone; a second ./course waits until the first has finished.

readonly log=$root/build/setup.log

make_environment() {
    local started=$SECONDS
    if ! mkdir -p "$root/build" 2>/dev/null || [ ! -w "$root/build" ]; then
        say "cannot write to $clone/${toolkit}build as $(id -un 2>/dev/null || id -u): the environment is made inside the clone."
        say "Next: clone the course into a folder of your own. If several people share this clone, it has changed since"
        say "its environment was made: ask the person who installed it to run $clone/course --help once."
        return 1
    fi
    exec 9>"$root/build/setup.lock"
    if ! flock -n 9; then
        say "another ./course is setting up this folder; waiting until it has finished"
        flock 9
    fi
    state=$(environment_state)
    if [ "$state" != ready ]; then
        : >"$log"
        rm -f "$root/build/apt-failed"
        if [ "$state" = stale ]; then update_environment; else new_environment; fi || return 1
        printf '%s\n%s\n%s\n' "$(fingerprint)" "$root" "$ros" >"$stamp.new" && mv "$stamp.new" "$stamp"
        say "the environment is ready ($((SECONDS - started)) s)"
    fi
    exec 9>&-
}

say() { echo "course: $*" >&2; }

# Say which step begins, and keep its name, which ends at the parenthesis, for `logged`.
begin() {
    step=${1%% (*}
    say "$1"
}

new_environment() {
    find_python || return 1
    ensure_system_packages "$(debian_name)-venv" "$(debian_name)-dev"
    begin "making the environment in ${toolkit}.venv with $("$python" --version) (1.3 GB; once, about a minute, longer on a busy machine; log: ${toolkit}build/setup.log)"
    rm -rf "$venv"
    { logged "$python" -m venv "$venv" && install_everything; } || explain_failure
}

update_environment() {
    begin "updating ${toolkit}.venv (files that the environment depends on have changed)"
    mv "$stamp" "$stamp.before"
    install_everything || { mv "$stamp.before" "$stamp"; explain_failure; }
}

# Set `python` to the first Python 3.10-3.14 found. A Python that cannot run, such as a version
# manager's shim for an inactive version, is skipped. The variable COURSE_PYTHON names another Python.
find_python() {
    local candidate candidates=(python3 python3.13 python3.12 python3.11 python3.10 python3.14)
    [ "$ros" = apt ] && candidates=("$(basename "$(dirname "$ros_python")")")
    [ -n "${COURSE_PYTHON:-}" ] && candidates=("$COURSE_PYTHON")
    command -v "${candidates[0]}" >/dev/null || ensure_system_packages python3
    for candidate in "${candidates[@]}"; do
        if "$candidate" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 14))' 2>/dev/null; then
            python=$(command -v "$candidate")
            return 0
        fi
    done
    say "no Python 3.10-3.14 was found (looked for: ${candidates[*]})."
    say "Next: install one, for example with  sudo apt-get install -y python3 python3-venv python3-dev,"
    say "or give the path of one:  COURSE_PYTHON=/path/to/python3.12 ./course"
    return 1
}

# Print the beginning of the names of Debian's packages for the chosen Python: python3 for the release's own.
debian_name() {
    if [ "$(readlink -f "$python")" = "$(readlink -f /usr/bin/python3)" ]; then echo python3; else basename "$python"; fi
}

install_everything() {
    local extras=dev build_tools=() isolation=()
    # The ROS build tools stay installed, because students build their own interfaces. The course's interfaces are built
    # with them, too: a build in uv's cache, below HOME or TMPDIR, could have a path that CMake rejects. ROS from apt
    # has the build tools already.
    [ "$ros" = wheels ] && extras=dev,ros-wheels build_tools=(-r "$root/setup/build-requirements.txt") isolation=(--no-build-isolation)
    write_constraints
    install_with_uv "$extras" || install_with_pip "$extras" || return 1
    compile_bytecode
}

# Arenas start hundreds of Python processes that must not write files; without compiled files each start takes twice as
# long. A file that cannot be compiled (a template, an old test) is ignored.
compile_bytecode() {
    begin "compiling the Python files (about 10 s, longer on a busy machine)"
    local packages=("$root"/{autograder,course_cli,lab,robot_sim,ros_cli,ros_runtime})
    logged env -u PYTHONDONTWRITEBYTECODE "$venv/bin/python" -m compileall -q -j 0 "$venv/lib" "${packages[@]}" || true
}

# Write the versions of requirements.lock; rclpy from apt needs NumPy 1, because it is compiled against Ubuntu's NumPy.
write_constraints() {
    if [ "$ros" = apt ]; then
        { grep -v '^numpy==' "$root/requirements.lock" && echo 'numpy<2'; } >"$venv/constraints.txt"
    else
        cp "$root/requirements.lock" "$venv/constraints.txt"
    fi
}

# uv is about ten times as fast as pip, but reads no pip configuration. If only pip's configuration names the mirror with
# the packages, uv fails and pip is used.
install_with_uv() {
    local extra extras=() uv=("$venv/bin/python" -m uv --no-config pip install --no-progress --python "$venv/bin/python"
        --constraints "$venv/constraints.txt" --build-constraints "$venv/constraints.txt")
    for extra in ${1//,/ }; do extras+=(--extra "$extra"); done
    logged "$venv/bin/python" -m pip install -c "$venv/constraints.txt" uv || return 1
    begin "installing packages (the first time a download of 300 MB: seconds to minutes, depending on your network)"
    with_uv -r "$root/pyproject.toml" "${extras[@]}" "${build_tools[@]}" || return 1
    begin "building humanoid_interfaces (about a minute; unchanged sources are not built again)"
    with_uv --no-deps --reinstall-package humanoid-course "${isolation[@]}" --editable "$root"
}

# A network that inspects encrypted connections uses a certificate that is in the system's list, but not in uv's list.
with_uv() {
    logged "${uv[@]}" "$@" || logged "${uv[@]}" --system-certs "$@"
}

install_with_pip() {
    begin "installing packages with pip (uv could not install them; 2 to 6 minutes)"
    local pip=("$venv/bin/python" -m pip install) PIP_CONSTRAINT=$venv/constraints.txt
    export PIP_CONSTRAINT PIP_BUILD_CONSTRAINT=$PIP_CONSTRAINT
    [ "$ros" = apt ] || logged "${pip[@]}" "${build_tools[@]}" || return 1
    logged "${pip[@]}" "${isolation[@]}" --editable "$root[$1]"
}

# Run a command with its output in the log, and show which step goes on: in a terminal a clock, elsewhere a line every 5 s.
logged() {
    local ticker status=0 beats=0 terminal=
    [ -t 2 ] && terminal=yes
    echo "+ $*" >>"$log"
    while sleep 1 >/dev/null 2>&1 && kill -0 $$ 2>/dev/null; do
        if [ -n "$terminal" ]; then
            printf '\r%d s ' $((SECONDS - started)) >&2
        elif [ $((++beats % 5)) = 0 ]; then
            say "still $step ($((SECONDS - started)) s since the beginning)"
        fi
    done 9>&- &
    ticker=$!
    "$@" >>"$log" 2>&1 </dev/null 9>&- || status=$?
    kill "$ticker" 2>/dev/null
    wait "$ticker" 2>/dev/null
    [ -n "$terminal" ] && printf '\r\033[K' >&2
    return $status
}

explain_failure() {
    tail -n 25 "$log" >&2
    say "the environment could not be made; above are the last lines of ${toolkit}build/setup.log."
    say "Next: correct the cause there (often no network, a full disk or no compiler), then run ./course again."
    return 1
}
