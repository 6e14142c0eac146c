#!/usr/bin/env bash
# Every public header compiles alone, as C++17, without a warning: headers_test.sh COMPILER...
set -u
cd -- "$(dirname -- "$0")/../include" || exit 1
status=0
for compiler; do
  for header in luxel/*.h; do
    said=$("$compiler" -std=c++17 -Wall -Wextra -Wpedantic -Wshadow -Werror -fsyntax-only -I. -include "$header" -x c++ /dev/null 2>&1) ||
      { echo "$compiler $header:"; echo "$said" | head -5; status=1; }
  done
done
exit $status
