# Unpacks Debian's packages into a folder, where a launcher starts one of their programs. Nothing is installed, and root is not needed.
#   fetch FOLDER FILE WHY PACKAGE...
# apt gets folders of its own and an empty list of installed packages. So it finds all dependencies of a program, whatever packages the system
# has, holds back or would conflict with. A shared library that the system has in exactly that version is left out. Everything else is needed in
# the folder, because a program looks for its parts beside itself.

get() {
    apt-get -o Dir::State="$apt/state" -o Dir::Cache="$apt/cache" -o Dir::State::status="$apt/status" -o Debug::NoLocking=1 \
        -o APT::Install-Recommends=0 -o APT::Sandbox::User= -o Acquire::Retries=3 -o Acquire::ForceHash=SHA256 --quiet=1 "$@"
}

# One line for each needed package: NAME VERSION BYTES. apt prints 'ADDRESS' NAME_VERSION_ARCHITECTURE.deb BYTES CHECKSUM.
needed() {
    # If apt cannot use the lists that it read, the next attempt reads them again.
    get install --yes --print-uris "$@" >"$apt/uris" || { rm -f "$apt/updated" && exit 1; }
    sed -n "s/^'[^']*' \([^_ ]*\)_\([^_ ]*\)_[^ ]*\.deb \([0-9]*\) .*/\1 \2 \3/p" "$apt/uris" | sed 's/%3a/:/'
}

unpack() {
    why=$1
    shift
    : >"$apt/status"
    if [ -z "$(find "$apt/updated" -mmin -10 2>/dev/null)" ]; then
        echo "reading Debian's lists of packages"
        get update >"$apt/said" || { cat "$apt/said" && echo "Debian's lists of packages cannot be had" && exit 1; }
        touch "$apt/updated"
    fi
    # The linker is that of the LLVM that the compiler was built with.
    [ "$1" != rustc-web ] || set -- "$@" "$(needed "$@" | sed -n 's/^libllvm\([0-9]*\) .*/lld-\1/p')"
    needed "$@" >"$apt/needed"
    # The C library is the system's, because it must match the program loader.
    dpkg-query --show --showformat='${db:Status-Status} ${Package} ${Version}\n' | sed -n 's/^installed //p' >"$apt/installed"
    awk -v installed="$apt/installed" -v named=" $* " 'BEGIN { while ((getline package <installed) > 0) has[package] = 1 }
        function is_library() { return $1 ~ /^lib/ && $1 !~ /-dev$/ && !index(named, " " $1 " ") }
        !(is_library() && ($1 " " $2) in has) && $1 != "libc6" && $1 != "libc-bin"' "$apt/needed" >"$apt/wanted"
    echo "fetching $*, needed $why: $(awk '{ n++; sum += $3 } END { print n " packages, " int(sum / 1e6) " MB" }' "$apt/wanted"), into $tree"
    cd "$apt/archives"
    rm -f ./*.deb
    # apt compares the files with the checksums in the signed lists.
    # Packages in the lists may be gone from the servers: the next attempt reads the lists again.
    get download $(awk '{ print $1 "=" $2 }' "$apt/wanted") || { rm "$apt/updated" && exit 1; }
    rm -rf "$tree.unfinished" "$tree"
    mkdir "$tree.unfinished"
    for package in ./*.deb; do
        echo "unpacking $package"
        dpkg-deb --extract "$package" "$tree.unfinished"
        rm "$package"
    done
    # In a folder that was moved, the compiler for controllers looks for newlib here.
    if [ -d "$tree.unfinished/usr/lib/arm-none-eabi" ]; then
        ln -s newlib "$tree.unfinished/usr/lib/arm-none-eabi/lib"
        ln -s ../../include/newlib "$tree.unfinished/usr/lib/arm-none-eabi/include"
    fi
    mv "$tree.unfinished" "$tree"
    # The list of unpacked packages, written last: its presence means that the folder is complete.
    awk '{ print $1, $2 }' "$apt/wanted" >"$tree/packages"
}

fetch() {
    tree=$1 file=$2 apt=$(dirname "$1")/apt
    shift 2
    mkdir -p "$apt/state/lists/partial" "$apt/cache/archives/partial" "$apt/archives"
    # Another process that fetches into the same folder waits.
    exec 9>"$apt/lock"
    flock 9
    [ -e "$tree/packages" ] || unpack "$@"
    # The folder can be moved. A browser uses the fonts in it and the system's.
    libraries=$(cd "$tree" && find . \( -name 'lib*.so' -o -name 'lib*.so.*' \) -printf ':$tree/%h\n' | sort -u | tr -d '\n')
    mkdir -p "$tree/launch"
    cat >"$tree/launch/${file##*/}" <<LAUNCHER
#!/bin/sh
tree=\$(CDPATH= cd -- "\$(dirname -- "\$0")/.." && pwd)
export LD_LIBRARY_PATH="${libraries#:}\${LD_LIBRARY_PATH:+:\$LD_LIBRARY_PATH}"
if [ -d "\$tree/usr/share/fonts" ]; then
    export FONTCONFIG_FILE="\$tree/fonts.conf"
    echo "<fontconfig><dir>\$tree/usr/share/fonts</dir><dir>/usr/share/fonts</dir><cachedir>\$tree/fonts</cachedir></fontconfig>" >"\$FONTCONFIG_FILE"
fi
exec "\$tree/$file" "\$@"
LAUNCHER
    chmod +x "$tree/launch/${file##*/}"
}

# The shell reads this script from standard input, so its programs must not read that.
fetch "$@" </dev/null >&2
