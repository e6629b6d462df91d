# Sourced by ./course: finds missing system packages, by the files and commands that they install.
#
# This takes about a millisecond and is done before every command. If the user is root, apt-get installs
# the missing packages; otherwise the command to type is printed. A missing package never stops a command.

readonly system_packages=(g++ bubblewrap libegl1 libopengl0 libgl1-mesa-dri)
readonly test_packages=(chromium libosmesa6 debootstrap)

has_system_package() {
    case $1 in
        g++) command -v c++ >/dev/null || command -v g++ >/dev/null ;;
        bubblewrap) command -v bwrap >/dev/null ;;
        # Pictures need these three packages for EGL, or OSMesa instead.
        libegl1) has_library libEGL.so.1 || has_library libOSMesa.so.8 ;;
        libopengl0) has_library libOpenGL.so.0 || has_library libOSMesa.so.8 ;;
        libgl1-mesa-dri) has_library dri/swrast_dri.so || has_library libOSMesa.so.8 ;;
        chromium | debootstrap) command -v "$1" >/dev/null ;;
        libosmesa6) has_library libOSMesa.so.8 ;;
        python3) command -v python3 >/dev/null ;;
        python3*-venv) "$python" -c 'import ensurepip' 2>/dev/null ;;
        python3*-dev) has_python_header ;;
    esac
}

without_system_package() {
    case $1 in
        g++) echo "the ROS interfaces cannot be built, which everything needs" ;;
        bubblewrap) echo "submissions cannot be isolated: grades are labelled untrusted" ;;
        libegl1 | libopengl0 | libgl1-mesa-dri) echo "no pictures of the robot" ;;
        chromium) echo "the robot's view is not tested in a browser" ;;
        libosmesa6) echo "pictures without EGL are not tested" ;;
        debootstrap) echo "the set-up on a bare machine is not tested" ;;
        python3 | python3*-venv) echo "the environment cannot be made" ;;
        python3*-dev) echo "the ROS interfaces cannot be built: Python.h is missing" ;;
    esac
}

has_library() {
    local folder
    for folder in /usr/lib/*-linux-gnu /usr/lib64 /usr/lib /usr/local/lib; do
        [ -e "$folder/$1" ] && return 0
    done
    return 1
}

has_python_header() {
    local code='import pathlib, sys, sysconfig; sys.exit(not pathlib.Path(sysconfig.get_path("include"), "Python.h").exists())'
    "$python" -c "$code"
}

# ensure_system_packages PACKAGE...: install the missing packages, or print how to install them.
ensure_system_packages() {
    local package missing=()
    for package; do
        has_system_package "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    if [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null && ! apt_failed_before "${missing[@]}"; then
        apt_install "${missing[@]}"
    fi
    report_missing "${missing[@]}"
}

# apt_failed_before PACKAGE...: whether apt-get has failed to install these. The next set-up tries again.
apt_failed_before() { [ "$(cat "$root/build/apt-failed" 2>/dev/null)" = "$*" ]; }

apt_install() {
    local package apt=(apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=2)
    export DEBIAN_FRONTEND=noninteractive
    mkdir -p "$root/build"
    echo "course: installing system packages: $* (up to a minute)" >&2
    {
        "${apt[@]}" update
        # If this fails, install one package at a time: this release may lack only one of them.
        "${apt[@]}" install -y --no-install-recommends "$@" ||
            for package; do "${apt[@]}" install -y --no-install-recommends "$package"; done
    } >"$root/build/apt.log" 2>&1 </dev/null
}

report_missing() {
    local package missing=()
    for package; do
        has_system_package "$package" || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        rm -f "$root/build/apt-failed"
        return
    fi
    [ "$(id -u)" -eq 0 ] && echo "$*" >"$root/build/apt-failed" && echo "course: apt-get could not install all packages; see build/apt.log" >&2
    echo "course: missing system packages. Type:  sudo apt-get install -y ${missing[*]}" >&2
    for package in "${missing[@]}"; do
        echo "course:   without $package: $(without_system_package "$package")" >&2
    done
}
