#!/usr/bin/env python3
"""Writes the skeleton of a kernel: signature, formula, notes, host API and a test that passes on every device.

Usage: new_kernel.py NAME   (snake_case; also: ./luxel new-kernel NAME)
"""
import keyword
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

FILES = {
    "kernels/NAME/NAME.signature.h": '''/* BUILD
   module f32x1: CHANNELS=1 PIXEL=f32x1
   module f32x4: PIXEL=f32x4
*/
#define PARAMETERS(_) \\
    _(int, width)    /* pixels */ \\
    _(int, height)   /* pixels */ \\
    _(float, factor) /* what every channel is multiplied by */
#define BINDINGS(_) \\
    _(READ, 0, PIXEL, src) \\
    _(WRITE, 1, PIXEL, dst)
''',
    "kernels/NAME/NAME.kernel.h": '''// dst(p) = factor * src(p).

KERNEL(NAME) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    store_pixel(dst, params.width, x, y, params.factor * load_pixel(src, params.width, x, y));
}
''',
    "kernels/NAME/README.md": '''# NAME

| | |
| --- | --- |
| formula | `dst(p) = factor * src(p)` |
| source | author, year, section |
| knobs | `factor`: any finite number, no unit |
| error | rounding: half a unit in the last place; method: none |
| extremes | NaN and infinities pass through |
| left out when not needed | nothing yet |
''',
    "include/luxel/NAME.h": '''/// \\file
/// NAME: what it computes, and its source (author, year, section).
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// What is done with an image.
struct CAMELParams {
  int width = 0;       ///< pixels, 1..65535
  int height = 0;      ///< pixels, 1..65535
  double factor = 1;   ///< any finite number
  Format format = Format::f32x4;  ///< of src and dst: f32x1, f32x4
};

/// Resources of the plan: `src` and `dst`, width * height pixels. Errors: invalid_argument, naming field, value and range.
Status validate(const CAMELParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const CAMELParams& params, const Profile& profile);

}  // namespace luxel
''',
    "host/NAME.cpp": '''#include <luxel/NAME.h>

#include <cfloat>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

Status validate(const CAMELParams& p) {
  LUXEL_CHECK(check_range("CAMELParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("CAMELParams.height", p.height, 1, 65535));
  LUXEL_CHECK(check_range("CAMELParams.factor", p.factor, -DBL_MAX, DBL_MAX));
  if (p.format != Format::f32x1 && p.format != Format::f32x4)
    return out_of_range("CAMELParams.format", name(p.format), "f32x1 or f32x4");
  return {};
}

Result<Plan> plan(const CAMELParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("NAME");
  Resource src{"src"}, dst{"dst"};
  src.format = dst.format = p.format;
  src.bytes = dst.bytes = static_cast<std::size_t>(p.width) * p.height * bytes_per_pixel(p.format);
  dst.written = true;
  const Slot from = planner.resource(src), to = planner.resource(dst);
  planner.pass("NAME", name(p.format), "NAME",
               {static_cast<std::uint32_t>(p.width), static_cast<std::uint32_t>(p.height), 1}, profile.pixels.workgroup,
               {{"width", p.width}, {"height", p.height}, {"factor", p.factor}}, {}, {{"src", from}, {"dst", to}});
  planner.cost(static_cast<double>(p.width) * p.height * channels(p.format), static_cast<double>(src.bytes + dst.bytes));
  return std::move(planner).finish();
}

}  // namespace luxel
''',
    "tests/NAME_test.cpp": '''#include <luxel/NAME.h>

#include <gtest/gtest.h>

#include "tests/support/run.h"

namespace luxel {
namespace {

TEST(CAMEL, MultipliesEveryChannelOnEveryDevice) {
  CAMELParams p;
  p.width = 37;
  p.height = 5;
  p.factor = 0.3;
  std::vector<float> picture(37 * 5 * 4);
  for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = 0.25f * static_cast<float>(i) - 3.0f;
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const std::vector<Bytes> out = run_bytes(context, plan(p, context.profile()).value(), {{"src", encode(p.format, picture)}}, {"dst"});
    const std::vector<double> result = decode(p.format, out.at(0));
    for (std::size_t i = 0; i < picture.size(); ++i) ASSERT_EQ(result[i], 0.3f * picture[i]) << device << " value " << i;
  }
}

TEST(CAMEL, RefusesWhatIsOutOfRange) {
  CAMELParams p;
  p.width = p.height = 8;
  EXPECT_TRUE(validate(p).ok());
  p.width = 0;
  EXPECT_EQ(validate(p).message(), "CAMELParams.width is 0; expected 1..65535");
}

}  // namespace
}  // namespace luxel
''',
}


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if len(sys.argv) == 2 else 2
    name = sys.argv[1]
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", name) or keyword.iskeyword(name):
        print(f"luxel: {name} is no kernel name; use snake_case, e.g. edge_mask", file=sys.stderr)
        return 2
    camel = "".join(word.capitalize() for word in name.split("_"))
    paths = {path.replace("NAME", name): text for path, text in FILES.items()}
    for path in paths:
        if (ROOT / path).exists():
            print(f"luxel: {path} exists already; choose another name", file=sys.stderr)
            return 2
    for path, text in paths.items():
        (ROOT / path).parent.mkdir(parents=True, exist_ok=True)
        (ROOT / path).write_text(text.replace("CAMEL", camel).replace("NAME", name))
        print(path)
    print(f"now: ./luxel test -R {name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
