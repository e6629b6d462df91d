# Sourced by ./course: a path for the clone that every tool below the course takes. LD_PRELOAD splits at spaces, CMake
# stumbles over "&" and letters beyond ASCII, the first lines of scripts over quotes.

# Print the path of a folder or, where it has other letters than these, that of a link to it which only its owner can change.
# The link stands in a folder of its own: the kernel lets nobody follow another's link that stands in /tmp itself.
plain_path() {
    local LC_ALL=C parent folder  # in C, A-Z are these letters and no others
    case $1 in
        *:*)
            refuse_path "$1" "has a colon, which separates folders in PATH"
            return 1
            ;;
        *[!A-Za-z0-9._/+-]*) ;;
        *)
            echo "$1"
            return
            ;;
    esac
    for parent in /var/tmp /tmp; do
        folder=$parent/humanoid-course-$(printf %s "$1" | sha256sum | cut -c1-12)
        mkdir -m 755 "$folder" 2>/dev/null
        if [ -d "$folder" ] && [ ! -L "$folder" ] && belongs_to_us "$folder" "$1"; then
            [ "$(readlink "$folder/clone")" = "$1" ] || ln -sfn "$1" "$folder/clone" 2>/dev/null
            [ "$(readlink "$folder/clone")" = "$1" ] && echo "$folder/clone" && return
        fi
    done
    refuse_path "$1" "has more than plain letters and digits, and no link to it can be made in /var/tmp or /tmp"
    return 1
}

# belongs_to_us FOLDER CLONE: nobody else can change what is in the folder but root and whoever owns the clone.
belongs_to_us() {
    local owner mode
    read -r owner mode < <(stat -c '%u %a' "$1")
    [[ $owner =~ ^(0|$(id -u)|$(stat -c %u "$2"))$ && $mode = 755 ]]
}

refuse_path() {
    echo "course: the path of this folder, $1, $2." >&2
    echo "course: Next: move it to a path of plain letters and digits, such as ~/course, and type the same command there." >&2
}
