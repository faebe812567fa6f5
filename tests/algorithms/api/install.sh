#!/usr/bin/env bash
# install.sh BUILD CXX: installs the library into a folder that is moved afterwards, builds the examples there from
# outside of the tree by CMake, and one in C by pkg-config, and runs them.
set -euo pipefail
build=$1 compiler=$2
here=$(cd "$(dirname "$0")/../../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for component in library development; do
  cmake --install "$build" --prefix "$folder/first" --component "$component" >"$folder/log"
done
mv "$folder/first" "$folder/prefix"  # nothing may know where it was installed first
library=$(find "$folder/prefix" -name libtouchstone.so)
export LD_LIBRARY_PATH=${library%/*}

# Nothing but the interface is exported.
strangers=$(nm -D --defined-only -C "$library" | grep -E 'touchstone::|Eigen::|boost::|fmt::|tbb::' | grep -v 'touchstone::v1::' || true)
if [[ -n $strangers ]]; then
  echo "the library exports:"
  head <<<"$strangers"
  exit 1
fi

cp -r "$here/algorithms/api/examples" "$folder/source"
cmake -S "$folder/source" -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_CXX_COMPILER="$compiler" >"$folder/log" ||
  { cat "$folder/log"; exit 1; }
cmake --build "$folder/build" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }

# expect EXAMPLE TEXT: the program ends well and prints the text.
expect() {
  local out
  out=$("$folder/build/$1") || { echo "$1 ended with $?: $out"; exit 1; }
  [[ $out == *"$2"* ]] || { printf '%s printed\n%s\nexpected\n%s\n' "$1" "$out" "$2"; exit 1; }
}
expect engine_loop 'body 0 meets body 5'
expect engine_loop '0.500'
expect planner_query 'clearance 0.200 m'
expect referee 'right, '
expect ray_picker 'ooo'
expect ray_picker '###'
expect ray_picker '^^^'
expect pairs_in_c 'distance 1.500 from x = 1.000 to x = 2.500
they touch at time 0.500
found -1.000000 as a radius'

if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH=${library%/*}/pkgconfig
  read -r -a flags <<<"$(pkg-config --cflags --libs touchstone)"
  cc -std=c99 -pedantic -Wall -Wextra -Werror "$folder/source/pairs_in_c.c" "${flags[@]}" -o "$folder/build/pairs_in_c"
  expect pairs_in_c 'distance 1.500'
fi
