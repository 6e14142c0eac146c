#!/usr/bin/env bash
# luxel as somebody else's project has it: installed, found, linked, run.
#
#   install_test.sh static BUILD               the library that BUILD has, installed
#   install_test.sh shared|opencl|vulkan BUILD a library of its own, of one small kernel: shared, and built without
#                                              exceptions and run-time types; with one execution
set -euo pipefail
kind=$1 build=$2
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
at=$build/install_test/$kind
prefix=$at/prefix
rm -rf "$prefix" "$at/consumer"
mkdir -p "$at"
run() { "$@" >"$at/log.txt" 2>&1 || { tail -n 40 "$at/log.txt"; echo "failed: $*"; exit 1; }; }

components="vulkan;opencl;reference" tools=OFF options=()
case $kind in
  static)
    run cmake --install "$build" --prefix "$prefix"
    tools=ON
    # A report's page is made by scripts that lie beside the program, wherever that was moved to.
    if [[ -x $prefix/bin/luxel ]]; then
      rm -rf "$at/moved" "$at/report"
      cp -r "$prefix" "$at/moved"
      [[ -e $at/moved/share/luxel/report/plots.py ]] || { echo "the scripts of reports are not installed"; exit 1; }
      echo 'import pathlib, sys; pathlib.Path(sys.argv[1], "from_prefix").touch()' >"$at/moved/share/luxel/report/render.py"
      run "$at/moved/bin/luxel" report --quick --kernel mip_build --device cpu:float --only 'no such job' -o "$at/report"
      [[ -e $at/report/from_prefix ]] || { echo "the installed program took scripts from elsewhere"; exit 1; }
    fi
    ;;
  shared) options=(-DBUILD_SHARED_LIBS=ON "-DCMAKE_CXX_FLAGS=-fno-exceptions -fno-rtti") ;;
  opencl) options=(-DLUXEL_VULKAN=OFF) components="opencl;reference" ;;
  vulkan) options=(-DLUXEL_OPENCL=OFF) components="vulkan" ;;
  *) echo "unknown: $kind"; exit 2 ;;
esac
if [[ $kind != static ]]; then
  run cmake -G Ninja -S "$root" -B "$at/build" -DCMAKE_BUILD_TYPE=Release -DLUXEL_KERNELS=discontinuity_mask -DLUXEL_TESTS=OFF \
    -DLUXEL_BENCH=OFF -DLUXEL_WERROR=ON "${options[@]}"
  run cmake --build "$at/build"
  run cmake --install "$at/build" --prefix "$prefix"
  # Only what was built is there.
  [[ -e $prefix/include/luxel/discontinuity_mask.h && ! -e $prefix/include/luxel/cone_trace.h ]] ||
    { echo "headers: $(ls "$prefix/include/luxel")"; exit 1; }
fi
if [[ $kind == shared ]]; then
  # The public calls are seen; what the library keeps to itself is not.
  seen=$(nm -DC --defined-only "$prefix"/lib*/libluxel.so)
  grep -q 'T luxel::plan(luxel::DiscontinuityMaskParams const&' <<<"$seen" || { echo "plan() is hidden"; exit 1; }
  grep -q 'T luxel::vulkan::Pipeline::record' <<<"$seen" || { echo "record() is hidden"; exit 1; }
  ! grep -E 'luxel::(Planner|find_module|check_range)|luxel::reference::module' <<<"$seen" || { echo "internals are seen"; exit 1; }
fi
run cmake -G Ninja -S "$root/tests/consumer" -B "$at/consumer" -DCMAKE_PREFIX_PATH="$prefix" "-DCONSUMER_COMPONENTS=$components" \
  -DCONSUMER_TOOLS=$tools
run cmake --build "$at/consumer"
found=$("$at/consumer/consumer") || exit 1
echo "$found"
[[ $found == *cpu:float* ]] || { echo "the C++ execution is missing"; exit 1; }
for api in vulkan opencl; do
  if [[ $components == *$api* ]]; then
    [[ $found == *$api:* ]] || { echo "$api is missing"; exit 1; }
  else
    [[ $found != *$api:* ]] || { echo "$api is there"; exit 1; }
  fi
done
# An execution that is not there is refused by name.
if [[ $kind == opencl ]]; then
  ! cmake -S "$root/tests/consumer" -B "$at/refused" -DCMAKE_PREFIX_PATH="$prefix" -DCONSUMER_COMPONENTS=vulkan >"$at/log.txt" 2>&1
  grep -q 'built without vulkan' "$at/log.txt" || { cat "$at/log.txt"; exit 1; }
fi
# The first kernel of docs/first_kernel.md: with the installed library, and from emitted files.
if [[ $kind == static && -x $prefix/bin/luxel ]]; then
  mine=$at/first_kernel expected='middle 0.009982, sum 1.000000'
  rm -rf "$mine"
  run cmake -G Ninja -S "$root/examples/first_kernel" -B "$mine" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release
  run cmake --build "$mine"
  run "$prefix/bin/luxel" emit gaussian_blur --size 256x256 --options sigma=4 --format cpp -o "$mine/blur"
  run g++ -std=c++17 -O2 -Wall -Wextra -Werror -I"$mine" "$root/examples/first_kernel/emitted.cpp" -o "$mine/emitted"
  for program in first_kernel emitted; do
    printed=$(cd "$mine" && "./$program") || exit 1
    [[ $printed == "$expected" ]] || { echo "$program printed: $printed"; exit 1; }
  done
fi
