# Unpacks Debian's packages into a folder, where a launcher starts a program of theirs: nothing is installed, and it takes no root.
#   fetch FOLDER FILE WHY PACKAGE...
# apt is given folders of its own, and a list of installed packages that is empty: so it finds everything that a program needs, whatever
# the system has, holds back or would not go together with. A package that the system has in just that version is left out.

get() {
    apt-get -o Dir::State="$apt/state" -o Dir::Cache="$apt/cache" -o Dir::State::status="$apt/status" -o Debug::NoLocking=1 \
        -o APT::Install-Recommends=0 -o APT::Sandbox::User= -o Acquire::Retries=3 -o Acquire::ForceHash=SHA256 --quiet=1 "$@"
}

# One line for each package that is needed: NAME VERSION BYTES. apt prints 'ADDRESS' NAME_VERSION_ARCHITECTURE.deb BYTES CHECKSUM.
needed() {
    # Lists that cannot be used, though apt took them for read, are read again by the next attempt.
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
    # The C library is the system's: the loader of programs must fit it.
    dpkg-query --show --showformat='${db:Status-Status} ${Package} ${Version}\n' | sed -n 's/^installed //p' >"$apt/installed"
    awk -v installed="$apt/installed" 'BEGIN { while ((getline package <installed) > 0) has[package] = 1 }
        !(($1 " " $2) in has) && $1 != "libc6" && $1 != "libc-bin"' "$apt/needed" >"$apt/wanted"
    echo "fetching $*, needed $why: $(awk '{ n++; sum += $3 } END { print n " packages, " int(sum / 1e6) " MB" }' "$apt/wanted"), into $tree"
    cd "$apt/archives"
    rm -f ./*.deb
    # apt compares the files with the checksums in the signed lists.
    # What the lists name may be gone from the servers: the next attempt reads them again.
    get download $(awk '{ print $1 "=" $2 }' "$apt/wanted") || { rm "$apt/updated" && exit 1; }
    rm -rf "$tree.unfinished" "$tree"
    mkdir "$tree.unfinished"
    for package in ./*.deb; do
        echo "unpacking $package"
        dpkg-deb --extract "$package" "$tree.unfinished"
        rm "$package"
    done
    # Where the compiler for controllers looks for newlib in a folder that was moved.
    if [ -d "$tree.unfinished/usr/lib/arm-none-eabi" ]; then
        ln -s newlib "$tree.unfinished/usr/lib/arm-none-eabi/lib"
        ln -s ../../include/newlib "$tree.unfinished/usr/lib/arm-none-eabi/include"
    fi
    mv "$tree.unfinished" "$tree"
    # Written last: what is in it.
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
    # The folder can be moved. A browser's fonts are those here and the system's.
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

# This script comes by the standard input, which the programs that it runs must not read.
fetch "$@" </dev/null >&2
