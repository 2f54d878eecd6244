#!/bin/sh
# Installs the Debian packages that a list names and that are missing; does nothing if none is.
#
#   cmake/install_packages.sh cmake/packages.txt [--foreign arm64]
set -eu

list=$1
if [ "${2:-}" = "--foreign" ]; then
  foreign=$3
else
  foreign=
fi

wanted=$(sed 's/#.*//' "$list" | tr -s ' \n' ' ')
missing=
for package in $wanted; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if ! command -v apt-get >/dev/null; then
  echo "These packages (Debian 12 names) are missing, and there is no apt-get to install them:" >&2
  echo " $missing" >&2
  exit 1
fi
if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "These packages are missing; as root, run:" >&2
  echo "  apt-get install$missing" >&2
  exit 1
fi

echo "Installing:$missing"
if [ -n "$foreign" ]; then
  $as_root dpkg --add-architecture "$foreign"
fi
$as_root apt-get update -qq
# shellcheck disable=SC2086  # words are meant to split
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
