#!/usr/bin/env bash
# install.sh BUILD CXX [PYTHON]: installs the library into a folder that is moved afterwards, builds the examples there from
# outside of the tree by CMake, and one in C by pkg-config, and runs them.
set -euo pipefail
build=$1 compiler=$2 python=${3:-}
here=$(cd "$(dirname "$0")/../../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for component in library development ${python:+python}; do
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

# Programs that were built before find what they were linked to. What is new is added to the list; nothing leaves it within a
# version of the interface.
nm -D --defined-only "$library" | sed 's/^[^ ]* . //' | grep -E '^(touchstone_|_Z(T[ISV])?NK?10touchstone)' | grep -v 5partsEv | LC_ALL=C sort >"$folder/symbols"
diff "$(dirname "$0")/symbols.txt" "$folder/symbols" || { echo "the exported symbols differ from symbols.txt"; exit 1; }

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

# The module finds the library by itself.
if [[ -n $python ]]; then
  out=$(env -u LD_LIBRARY_PATH PYTHONPATH="$folder/prefix/lib/python3/dist-packages" "$python" -c '
import touchstone as ts
ball = ts.Body(ts.Shape.sphere(1), ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [3, 0, 0]))
found = ts.exact.distance(ts.Body(ts.Shape.box([1, 1, 1])), ball)
print(found.lower, ts.verify(found.certificate), ts.check)')
  [[ $out == "1 True <function check"* ]] || { echo "Python printed: $out"; exit 1; }
fi
