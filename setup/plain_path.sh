# Sourced by ./course: finds a path of the clone that all tools accept. LD_PRELOAD splits paths at spaces, CMake fails
# with "&" and non-ASCII characters, and the first line of a script fails with quotes.

# Print the path of a folder. If it has other characters than these, print the path of a link to the folder, which only
# its owner can change. The link has a folder of its own: the kernel refuses to follow another user's link in /tmp.
plain_path() {
    local LC_ALL=C parent folder  # in the locale C, A-Z matches only ASCII letters
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
    refuse_path "$1" "has special characters, and no link to it can be made in /var/tmp or /tmp"
    return 1
}

# belongs_to_us FOLDER CLONE: only this user, root and the clone's owner can change the content of the folder.
belongs_to_us() {
    local owner mode
    read -r owner mode < <(stat -c '%u %a' "$1")
    [[ $owner =~ ^(0|$(id -u)|$(stat -c %u "$2"))$ && $mode = 755 ]]
}

refuse_path() {
    echo "course: the path of this folder, $1, $2." >&2
    echo "course: Next: move it to a path of ASCII letters and digits, such as ~/course, and type the command again." >&2
}
