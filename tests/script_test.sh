#!/usr/bin/env bash
# Checks of the script `luxel` on a small project of its own, with apt-get, sudo and dpkg-query replaced by recorders.
# usage: script_test.sh SOURCE_ROOT
set -uo pipefail

source_root=$(readlink -f -- "${1:-$(dirname -- "${BASH_SOURCE[0]}")/..}")
work=$(mktemp -d "${TMPDIR:-/tmp}/luxel script.XXXXXX") || exit 1
trap 'rm -rf -- "$work"' EXIT
root="$work/a clone"
fakes="$work/fakes"
failures=0
checks=0

mkdir -p "$root/.ci" "$fakes" "$work/home"
cp "$source_root/luxel" "$source_root/CMakePresets.json" "$root/"
cp "$source_root/.ci/run" "$root/.ci/"
export HOME="$work/home" FAKES="$fakes" PATH="$fakes:$PATH"
unset LUXEL_PRESET LUXEL_BACKENDS LUXEL_PACKAGES LUXEL_JOBS XDG_CACHE_HOME CI DEBIAN_FRONTEND

fake() {  # NAME, script on stdin
  { echo '#!/bin/sh'; cat; } >"$fakes/$1"
  chmod +x "$fakes/$1"
}
fake dpkg-query <<'END'
for name in $(cat "$FAKES/installed"); do echo "installed $name"; done
echo "config-files gamma"
END
fake id <<'END'
case $1 in -u) cat "$FAKES/uid" ;; *) echo somebody ;; esac
END
fake apt-get <<'END'
echo "apt-get $*" >>"$FAKES/calls"
[ "$DEBIAN_FRONTEND" = noninteractive ] || echo "a frontend that asks" >>"$FAKES/calls"
read -r answer && echo "something to read" >>"$FAKES/calls"
[ ! -e "$FAKES/apt_fails" ] || { echo "E: no such archive"; exit 100; }
case " $* " in *" install "*) echo "alpha beta gamma" >"$FAKES/installed" ;; esac
END
fake sudo <<'END'
[ ! -e "$FAKES/sudo_fails" ] || exit 1
echo "sudo" >>"$FAKES/calls"
[ "$1" != -n ] || shift
exec "$@"
END
echo "alpha beta gamma" >"$fakes/installed"
echo 0 >"$fakes/uid"

cat >"$root/packages.txt" <<'END'
# a comment
alpha   why

beta    why
gamma
END
cat >"$root/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.22)
project(fake LANGUAGES NONE)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
add_custom_command(OUTPUT bin/luxel COMMAND sh ${CMAKE_SOURCE_DIR}/compile.sh ${CMAKE_SOURCE_DIR}/program.sh bin/luxel
                   DEPENDS program.sh VERBATIM)
add_custom_target(program ALL DEPENDS bin/luxel)
enable_testing()
include(${CMAKE_SOURCE_DIR}/tests.cmake)
END
cat >"$root/compile.sh" <<'END'
echo "a chatty compiler"
if grep -q mistake "$1"; then echo "program.sh: error: a mistake"; exit 1; fi
echo compiled >>"$FAKES/compiled"
cp "$1" "$2" && chmod +x "$2"
END
write_program() {
  cat >"$root/program.sh" <<'END'
#!/bin/sh
case $1 in
  devices) printf 'index  api     name\n'; for api in $(cat "$FAKES/backends"); do echo "0  $api  a vulkan device"; done ;;
  --help) echo "help of the program" ;;
  status) exit "$2" ;;
  where) pwd ;;
  stdin) [ -e /proc/self/fd/0 ] ;;
  cache) echo "${XDG_CACHE_HOME:-[cache]}" ;;
  *) for argument; do echo "[$argument]"; done ;;
esac
END
}
write_program
echo "opencl vulkan cpu" >"$fakes/backends"
cat >"$root/tests.cmake" <<'END'
add_test(NAME short COMMAND sh -c "echo short >>\"$FAKES/tests\"")
set_tests_properties(short PROPERTIES LABELS quick)
add_test(NAME long COMMAND sh -c "echo long >>\"$FAKES/tests\"")
set_tests_properties(long PROPERTIES LABELS full)
END

run() {  # sets status, out, err, calls
  : >"$fakes/calls"
  : >"$fakes/tests"
  "$@" >"$work/out" 2>"$work/err" <&-
  status=$?
  out=$(cat "$work/out") err=$(cat "$work/err") calls=$(cat "$fakes/calls")
}
check() {  # NAME, then a condition
  checks=$((checks + 1))
  local name=$1
  shift
  "$@" && return
  failures=$((failures + 1))
  printf 'FAILED: %s\n  status %s\n  stdout: %s\n  stderr: %s\n  calls: %s\n' "$name" "$status" "$out" "$err" "$calls"
}
has() { [[ $1 == *"$2"* ]]; }
lacks() { [[ $1 != *"$2"* ]]; }
compilations() { grep -c . "$fakes/compiled" 2>/dev/null || true; }
script="$root/luxel"

# Help builds nothing.
run "$script"
check "no argument prints the usage" has "$out" "usage: ./luxel report"
check "no argument is no error" test "$status" = 0
check "no argument builds nothing" test ! -e "$root/build"
run "$script" --help
check "--help prints the usage" has "$out" "usage: ./luxel report"
check "--help builds nothing" test ! -e "$root/build"

# Usage errors.
LUXEL_PRESET=fastest run "$script" report
check "an unknown preset is a usage error" test "$status" = 2
check "an unknown preset is named" has "$err" "LUXEL_PRESET is fastest; expected one of: dev"
LUXEL_BACKENDS="cpu metal" run "$script" test
check "an unknown backend is a usage error" test "$status" = 2
check "an unknown backend is named" has "$err" "LUXEL_BACKENDS names metal"
LUXEL_JOBS=0 run "$script" report
check "no jobs is a usage error" test "$status" = 2

# Building and running.
run "$script" report --size "two words" "" 'a*'
check "arguments arrive as they are" test "$out" = $'[report]\n[--size]\n[two words]\n[]\n[a*]'
check "the program's status is the script's" test "$status" = 0
check "installed packages need no apt-get" test -z "$calls"
check "chatter stays in the log" lacks "$err" "chatty"
check "chatter is in the log" grep -q chatty "$root/build/release/build.log"
run "$script" stdin
check "a closed stdin is opened for the program" test "$status" = 0
run "$script" status 7
check "a status passes through" test "$status" = 7
check "a second call builds nothing" test "$(compilations)" = 1
check "a second call says nothing" test -z "$err"
sed -i 's/devices)/devices) : changed;/' "$root/program.sh"
run "$script" list
check "a change is built" test "$(compilations)" = 2
check "a change is not configured again" lacks "$err" configuring
touch -d '1 minute' "$root/CMakePresets.json"
run "$script" list
check "changed presets are configured again" has "$err" configuring
touch -d '1 hour ago' "$root/CMakePresets.json" "$root/packages.txt"
run "$script" --help
check "the program's help follows the script's" has "$out" "help of the program"
LUXEL_PRESET=dev run "$script" list
check "another preset has its own folder" test -x "$root/build/dev/bin/luxel"
(cd "$work" && ln -s "a clone/luxel" link)
cd "$work/home" || exit 1
run "$work/link" where
check "a link works, and the working directory stays" test "$out" = "$work/home"
mv "$root" "$work/moved"
run "$work/moved/luxel" list
check "a moved clone builds" test "$status:$out" = "0:[list]"
mv "$work/moved" "$root"
echo "message(FATAL_ERROR \"a library is missing\")" >>"$root/CMakeLists.txt"
run "$script" list
check "a failed configuration is a failure" test "$status" = 1
check "a failed configuration shows the error" has "$err" "a library is missing"
sed -i '$d' "$root/CMakeLists.txt"
run "$script" list
check "after the mending it is configured again" test "$status:$out" = "0:[list]"

# A build that fails.
echo "mistake" >>"$root/program.sh"
run "$script" report
check "a failed build is a failure" test "$status" = 1
check "a failed build shows the error" has "$err" "program.sh: error: a mistake"
check "a failed build names its log" has "$err" "$root/build/release/build.log"
check "a failed build prints nothing else" test -z "$out"
write_program

# The skeleton of a kernel.
mkdir -p "$root/kernels/portable"
echo 'import sys; print(sys.argv[1:]); sys.exit(3)' >"$root/kernels/portable/new_kernel.py"
built=$(compilations)
run "$script" new-kernel edge_mask
check "new-kernel runs the skeleton's script" test "$status:$out" = "3:['edge_mask']"
check "new-kernel builds nothing" test "$(compilations)" = "$built"

# Packages.
echo "beta" >"$fakes/installed"
run "$script" list
check "missing packages are no error" test "$status:$out" = "0:[list]"
check "exactly the missing packages are installed" has "$calls" "install -y --no-install-recommends alpha gamma"
check "nothing else is installed" has "$calls|" "alpha gamma|"
check "the lists are updated first" has "${calls%%install*}" " update"
check "root needs no sudo" lacks "$calls" sudo
check "nothing asks" lacks "$calls" asks
check "nothing waits for an answer" lacks "$calls" read
echo 1000 >"$fakes/uid"
echo "beta" >"$fakes/installed"
run "$script" list
check "others use sudo" has "$calls" $'sudo\napt-get'
echo "beta" >"$fakes/installed"
touch "$fakes/sudo_fails"
run "$script" list
check "without sudo it is a failure" test "$status" = 1
check "without sudo the packages are named" has "$err" "apt-get install --no-install-recommends alpha gamma"
check "the message is one line" test "$(wc -l <"$work/err")" = 1
LUXEL_PACKAGES=skip run "$script" list
check "the packages can be left alone" test "$status:$out" = "0:[list]"
rm "$fakes/sudo_fails"
touch "$fakes/apt_fails"
run "$script" list
check "a failing apt-get is a failure" test "$status" = 1
check "a failing apt-get shows its error" has "$err" "E: no such archive"
check "a failing apt-get names the packages" has "$err" "alpha gamma"
rm "$fakes/apt_fails"
echo "alpha beta gamma" >"$fakes/installed"
echo 0 >"$fakes/uid"

# Tests.
run "$script" test
check "passing tests pass" test "$status" = 0
check "all labels are run" test "$(sort "$fakes/tests" | tr '\n' ' ')" = "long short "
check "the closing line is ctest's" has "$(tail -n 1 "$work/out")" "Total Test time"
check "the tests are built by the preset ci" test -x "$root/build/ci/bin/luxel"
CI=true run bash "$root/.ci/run"
check "CI's entry runs them" test "$status:$(sort "$fakes/tests" | tr '\n' ' ')" = "0:long short "
run "$script" test --quick
check "--quick runs the label quick" test "$status:$(cat "$fakes/tests")" = "0:short"
run "$script" test -R long
check "arguments go to ctest" test "$status:$(cat "$fakes/tests")" = "0:long"
run "$script" test -N
check "a listing is no failure" test "$status" = 0
check "a listing runs nothing" test ! -s "$fakes/tests"
run "$script" test -R nothing_of_the_sort
check "no test is a failure" test "$status" != 0
echo "opencl cpu" >"$fakes/backends"
run "$script" test
check "a missing backend is a failure" test "$status" = 1
check "a missing backend is named" has "$err" "backend vulkan is expected and missing"
check "a missing backend stops before the tests" test ! -s "$fakes/tests"
LUXEL_BACKENDS="opencl cpu" run "$script" test
check "expectations can be told" test "$status" = 0
echo >"$fakes/backends"
LUXEL_BACKENDS="" run "$script" test
check "no expectation, no check" test "$status" = 0
echo "opencl vulkan cpu" >"$fakes/backends"
cp "$root/tests.cmake" "$work/tests.cmake"
echo 'add_test(NAME broken COMMAND false)' >>"$root/tests.cmake"
run "$script" test
check "a failing test is a failure" test "$status" != 0
CI=true run bash "$root/.ci/run"
check "a failing test fails CI" test "$status" != 0
sed 's/sh -c.*/sh -c "exit 77")/; s/LABELS/SKIP_RETURN_CODE 77 LABELS/' "$work/tests.cmake" >"$root/tests.cmake"
run "$script" test
check "skipping every test is a failure" test "$status" = 1
check "skipping every test is told" has "$err" "no test was executed"

# Places that cannot be written.
run "$script" cache
check "the user's cache is left alone" test "$out" = "[cache]"
HOME="$work/link/home" run "$script" cache
check "without a home, caches go to the build folder" test "$out" = "$root/build/cache"
rm -rf "$root/build"
: >"$root/build"
run "$script" list
check "an unwritable build folder is a failure" test "$status:$out" = "1:"
check "an unwritable build folder is named" has "$err" "cannot write under $root/build"
check "that message is one line" test "$(wc -l <"$work/err")" = 1

echo "$checks checks, $failures failed"
[[ $failures == 0 ]]
