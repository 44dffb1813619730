#!/usr/bin/env bash
# Builds and tests this source in another release of Debian, in a chroot that
# debootstrap makes (package debootstrap; as root):
#
#   doc/other_debian.sh RELEASE FOLDER [COMMAND...]
#
# RELEASE is trixie (Debian 13), bookworm (12) or another. FOLDER is where the
# chroot is, or comes to be: 6 GB for trixie, of which 0.9 GB are downloaded.
# Without COMMAND the two of README.md are run; with one, that alone, for example
# "bash". A second call takes the chroot as it is, copies what has changed of the
# source, and compiles that.
#
# From the environment: CXX, another compiler (clang++: the package clang is
# installed, and the source copied to a folder of its own); MIRROR, the address of
# a Debian mirror, by default that of this machine's apt; and what CMake and CTest
# read there, such as CMAKE_BUILD_PARALLEL_LEVEL.
set -euo pipefail

if [ $# -lt 2 ]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//p}' "$0"
  exit 2
fi
release=$1 root=$(realpath -m "$2")
shift 2
cd "$(dirname "$0")/.."
compiler=${CXX:-c++}
source=/crevasse_${compiler##*/}

if [ "$(id -u)" != 0 ]; then
  echo "other_debian.sh: debootstrap, mount and chroot need root: sudo $0 …" >&2
  exit 1
fi

# Mounts that end with the command, and are seen by it alone.
inside() {
  unshare --mount --pid --fork --kill-child bash -c '
    mount --rbind /dev "$0/dev" && mount --rbind /sys "$0/sys" &&
    mount -t proc proc "$0/proc" && exec chroot "$0" "$@"
  ' "$root" env LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"
}

if [ ! -e "$root/made" ]; then
  mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' \
    'Created-By: Packages' 'Origin: Debian' | sed -n 1p)}
  debootstrap --variant=minbase "$release" "$root" "$mirror"
  touch "$root/made"
fi

# With mold, which Debian 13's deal.II asks for, test programs are linked in
# seconds; without it in a minute and more each.
packages="$(cat doc/debian-packages.txt) mold"
case $compiler in *clang*) packages="$packages clang" ;; esac
if [ "$(cat "$root/installed" 2>/dev/null)" != "$packages" ]; then
  inside apt-get update
  # shellcheck disable=SC2086  # many words are meant
  inside apt-get install -y --no-install-recommends $packages
  echo "$packages" > "$root/installed"
fi

# With the dates of the files, by which ninja knows what has changed.
mkdir -p "$root$source"
find "$root$source" -mindepth 1 -maxdepth 1 ! -name build ! -name results \
  -exec rm -r {} +
git ls-files -z --cached --others --exclude-standard |
  tar --create --null --files-from=- | tar --extract --directory "$root$source"

if [ $# = 0 ]; then
  set -- bash -c 'cmake --workflow --preset run && cmake --workflow --preset test'
fi
inside bash -c 'cd "$0" && exec "$@"' "$source" "$@"
