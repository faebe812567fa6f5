#!/bin/sh
# Unpacks the meshes of Debian's package libcgal-demo into datasets/local/cgal, where cgal_meshes.toml
# looks for them. They stay out of the repository.
set -eu
archive=/usr/share/doc/libcgal-dev/data.tar.gz
folder=$(cd "$(dirname "$0")" && pwd)/local
if [ ! -r "$archive" ]; then
  echo "$0: $archive is not there; expected Debian's package: sudo apt-get install libcgal-demo" >&2
  exit 2
fi
mkdir -p "$folder"
unpacked=$(mktemp -d "$folder/unpacking.XXXXXX")
trap 'rm -rf "$unpacked"' EXIT
tar -xzf "$archive" -C "$unpacked" data/meshes
rm -rf "$folder/cgal"
mv "$unpacked/data/meshes" "$folder/cgal"
echo "$(ls "$folder/cgal" | wc -l) meshes in $folder/cgal"
