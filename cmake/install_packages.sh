#!/bin/sh
# Installs the Debian packages that packages.txt lists for the groups named, as far as they are
# missing. With nothing missing it asks for nothing, changes nothing and needs no network.
#
#   cmake/install_packages.sh program test
set -eu

list=$(dirname "$0")/packages.txt

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "This is not a Debian system: install what $list names by your own means." >&2
  exit 0
fi

# A package may be there for another architecture too, or only.
native=$(dpkg --print-architecture)
missing=
for group in "$@"; do
  for package in $(awk -v group="$group" '$1 == group { print $2 }' "$list"); do
    dpkg-query -W -f '${db:Status-Status} ${Architecture}\n' "$package" 2>/dev/null |
      grep -qxE "installed ($native|all)" || missing="$missing $package"
  done
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null 2>&1; then
  as_root=sudo
else
  echo "These packages are missing, and neither root nor sudo is at hand to install them. As root:" >&2
  echo "    apt-get install --no-install-recommends$missing" >&2
  exit 1
fi

echo "Installing what is missing:$missing"
# Word splitting is meant: a command that may be empty, and a list of names.
# shellcheck disable=SC2086
$as_root apt-get -qq update
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get -qq -o DPkg::Lock::Timeout=300 install -y --no-install-recommends $missing
