#!/usr/bin/env bash
# Installs crevasse_*.deb in a bare chroot of its release of Debian, and runs two
# scenes, a sweep and their reports there (package debootstrap; as root):
#
#   packaging/try_deb.sh PACKAGE.deb RELEASE FOLDER
#
# RELEASE is the one that the package was built on: bookworm (Debian 12) or trixie
# (13). FOLDER is where the chroot comes to be, and is left for another look.
set -euo pipefail

if [ $# -ne 3 ]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//p}' "$0"
  exit 2
fi
package=$(realpath "$1") release=$2 root=$(realpath -m "$3")

mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' \
  'Created-By: Packages' 'Origin: Debian' | sed -n 1p)}
debootstrap --variant=minbase "$release" "$root" "$mirror"
cp "$package" "$root/root/crevasse.deb"

# Mounts that end with the command, and are seen by it alone.
unshare --mount --pid --fork --kill-child bash -c '
  mount --rbind /dev "$0/dev" && mount -t proc proc "$0/proc" &&
  exec chroot "$0" "$@"
' "$root" env LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 bash -euxc '
  apt-get update
  apt-get install -y --no-install-recommends /root/crevasse.deb
  cd /root
  examples=/usr/share/doc/crevasse/examples/prm
  crevasse --version
  crevasse $examples/raous1980.prm
  crevasse report results/raous1980
  crevasse $examples/two_cracks.prm
  crevasse report results/two_cracks
  crevasse sweep $examples/crack_growth.prm --vary "Geometry/Crack length=5,10"
  crevasse report results/crack_growth_sweep
  PYTHONPATH=/usr/share/crevasse/python python3 -c "
import crevasse
print(crevasse.read(\"results/raous1980\").probe(\"C\").tail())"
  dpkg -L crevasse | head -30; dpkg -s crevasse | grep Depends; ls -l results/raous1980/report.html'
