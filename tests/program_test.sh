#!/usr/bin/env bash
# The built program ($1) on real and on broken input: exit status, one line on stderr, and what it writes.
# Real files come from LUXEL_DATA (default ../shared/data beside the source); without them those cases are skipped visibly.
set -u
[[ $# -ge 1 ]] || { echo "usage: $0 PROGRAM" >&2; exit 2; }
luxel=$(readlink -f -- "$1")
root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
data=${LUXEL_DATA:-$root/../shared/data}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
checks=0 failures=0

fail() {
  failures=$((failures + 1))
  printf 'FAILED: %s\n' "$1"
  [[ ${2:-} ]] && sed 's/^/    /' <<<"$2"
}

# expect STATUS PATTERN COMMAND...: on 0 stderr is empty and stdout matches; else stdout is empty and stderr is one line
# that begins with "luxel: " and matches.
expect() {
  local status=$1 pattern=$2 got
  shift 2
  checks=$((checks + 1))
  "$@" >out.txt 2>err.txt </dev/null
  got=$?
  [[ $got == "$status" ]] || { fail "$*: exit status $got, expected $status" "$(cat out.txt err.txt)"; return 1; }
  if [[ $status == 0 ]]; then
    [[ ! -s err.txt ]] || fail "$*: something on stderr" "$(cat err.txt)"
    grep -Eq -- "$pattern" out.txt || fail "$*: stdout does not match $pattern" "$(cat out.txt)"
  else
    [[ ! -s out.txt ]] || fail "$*: something on stdout" "$(cat out.txt)"
    [[ $(wc -l <err.txt) == 1 && $(head -c 7 err.txt) == 'luxel: ' ]] || fail "$*: not one line on stderr" "$(cat err.txt)"
    grep -Eq -- "$pattern" err.txt || fail "$*: stderr does not match $pattern" "$(cat err.txt)"
  fi
}

same() {
  checks=$((checks + 1))
  cmp -s -- "$1" "$2" || fail "$1 and $2 differ"
}

# Python lines with `read(path)` -> (shape, values) and `write(path, shape, values)` for float32 NPY files; asserts fail.
python() {
  checks=$((checks + 1))
  python3 - "$@" 2>err.txt <<END || fail "python: $*" "$(cat err.txt)"
import ast, math, struct, sys
def read(path):
    b = open(path, 'rb').read()
    assert b[:8] == b'\x93NUMPY\x01\x00', path
    n = struct.unpack('<H', b[8:10])[0]
    h = ast.literal_eval(b[10:10 + n].decode())
    assert h['descr'] == '<f4' and not h['fortran_order'], h
    count = math.prod(h['shape'])
    assert len(b) == 10 + n + 4 * count
    return h['shape'], struct.unpack('<%df' % count, b[10 + n:])
def write(path, shape, values, order=False):
    h = "{'descr': '<f4', 'fortran_order': %s, 'shape': %s, }" % (order, tuple(shape))
    h += ' ' * (-(11 + len(h)) % 64) + '\n'
    open(path, 'wb').write(b'\x93NUMPY\x01\x00' + struct.pack('<H', len(h)) + h.encode() + struct.pack('<%df' % len(values), *values))
$(cat)
END
}

python <<'END'
write('ramp.npy', (4, 6), [float(i) for i in range(24)])
write('flat.npy', (9, 7, 3), [0.1] * 189)
write('spike.npy', (15, 15), [1.0 if i == 112 else 0.0 for i in range(225)])
write('volume.npy', (2, 4, 4, 4), [(i % 7) / 8 for i in range(128)])
write('hidden.npy', (2, 2, 4), [float('nan'), 0, 0, 0] + [0.5, 0.25, 0, 0.5] + [float('inf'), 0, 0, 1] + [1.0] * 4)
write('fortran.npy', (4, 6), [0.0] * 24, True)
write('line.npy', (24,), [0.0] * 24)
write('wide.npy', (2, 2, 5), [0.0] * 20)
write('slices.npy', (8, 8, 8), [0.0] * 512)
write('one.npy', (1, 1), [1.0])
END

# ---- Help, lists, and words that nobody knows
expect 0 'gaussian_blur' "$luxel" --help
expect 0 '^luxel [0-9]+\.[0-9]+\.[0-9]+$' "$luxel" --version
for command in devices list bench report stability tune gaussian_blur bilateral mip_build cone_trace; do expect 0 "Usage: luxel $command" "$luxel" "$command" --help; done
expect 0 'sigma.*0\.\.10000' "$luxel" gaussian_blur --help
expect 0 'radius.*0\.\.4095.*default ceil\(3 sigma\)' "$luxel" gaussian_blur --help
expect 0 'clamp\|mirror\|wrap\|zero; default clamp' "$luxel" gaussian_blur --help
expect 0 'isotropic\|anisotropic\|gaussian3\|min\|max\|minmax\|moments' "$luxel" mip_build --help
expect 0 '--levels +0\.\.16, whole, default 0' "$luxel" list
expect 0 '^gaussian_blur: ' "$luxel" list gaussian_blur
grep -q mip_build out.txt && fail "list gaussian_blur lists more than that"
expect 2 'no kernel blur; expected gaussian_blur, ' "$luxel" list blur
expect 2 'no command given; see `luxel --help`' "$luxel"
expect 2 'unknown command gausian_blur; did you mean gaussian_blur\?' "$luxel" gausian_blur --in ramp.npy
expect 2 'unknown command qqqqqq; see' "$luxel" qqqqqq
expect 2 'unknown option --simga; did you mean --sigma\?' "$luxel" gaussian_blur --simga 4 --in ramp.npy -o a.npy
expect 2 'unknown option --helpp; did you mean --help\?' "$luxel" --helpp
expect 2 'unexpected argument more' "$luxel" gaussian_blur --in ramp.npy --sigma 1 -o a.npy more
expect 2 'unknown option --border2=clamp; did you mean --border\?' "$luxel" gaussian_blur --in ramp.npy --sigma 1 -o a.npy --border2=clamp
if [[ -w /dev/full ]]; then
  checks=$((checks + 1))
  "$luxel" list >/dev/full 2>err.txt
  [[ $? == 1 && $(cat err.txt) == 'luxel: cannot write to stdout; check where it goes' ]] || fail "list >/dev/full" "$(cat err.txt)"
fi

checks=$((checks + 1))
"$luxel" devices >devices.txt 2>problems.txt || fail "devices: exit status $?"
grep -Eq '^[0-9]+ +cpu +C\+\+ float ' devices.txt || fail "devices does not list C++ float" "$(cat devices.txt)"
grep -vq '^luxel: ' problems.txt && fail "devices: stderr" "$(cat problems.txt)"
devices=cpu
for api in opencl vulkan; do grep -Eq "^[0-9]+ +$api " devices.txt && devices+=" $api"; done
echo "devices: $devices"

# ---- Refused values: 2, and no file
blur=("$luxel" gaussian_blur --device cpu)
mips=("$luxel" mip_build --device cpu)
expect 2 '--in is required' "${blur[@]}" --sigma 1 -o a.npy
expect 2 '--sigma is required' "${blur[@]}" --in ramp.npy -o a.npy
expect 2 '--out is required' "${blur[@]}" --in ramp.npy --sigma 1
expect 2 '--sigma: -1 is out of range; expected 0\.\.10000' "${blur[@]}" --in ramp.npy --sigma -1 -o a.npy
expect 2 '--sigma: 10000\.5 is out of range' "${blur[@]}" --in ramp.npy --sigma 10000.5 -o a.npy
expect 2 '--sigma: nan is out of range' "${blur[@]}" --in ramp.npy --sigma nan -o a.npy
expect 2 '--sigma: four is not a number' "${blur[@]}" --in ramp.npy --sigma four -o a.npy
expect 2 '--radius: 4096 is out of range; expected a whole number 0\.\.4095' "${blur[@]}" --in ramp.npy --sigma 1 --radius 4096 -o a.npy
expect 2 '--radius: 2\.5 is out of range' "${blur[@]}" --in ramp.npy --sigma 1 --radius 2.5 -o a.npy
expect 2 'sigma is 2000; expected 0\.\.1365, or a radius' "${blur[@]}" --in ramp.npy --sigma 2000 -o a.npy
expect 2 '--border: edge is not known; expected clamp, mirror, wrap, zero' "${blur[@]}" --in ramp.npy --sigma 1 --border edge -o a.npy
expect 2 '--variant: blob is not known' "${blur[@]}" --in ramp.npy --sigma 1 --variant blob -o a.npy
expect 2 'border is mirror; expected clamp or wrap for variant sampler' "${blur[@]}" --in ramp.npy --sigma 1 --variant sampler --border mirror -o a.npy
expect 2 'keep_alpha' "${blur[@]}" --in ramp.npy --sigma 1 --keep-alpha -o a.npy
expect 2 'a\.jpg: has the unknown extension \.jpg; expected \.exr, \.hdr, \.png or \.npy' "${blur[@]}" --in ramp.npy --sigma 1 -o a.jpg
expect 2 'a: has no extension' "${blur[@]}" --in ramp.npy --sigma 1 -o a
expect 2 "'nothing'" "$luxel" gaussian_blur --in ramp.npy --sigma 1 --device nothing -o a.npy
expect 2 '--levels: 17 is out of range; expected a whole number 0\.\.16' "${mips[@]}" --in ramp.npy --levels 17 -o a
expect 2 'levels is 9; expected 0\.\.2' "${mips[@]}" --in ramp.npy --levels 9 -o a
expect 2 'sizes is ceil; expected floor for variant isotropic' "${mips[@]}" --in ramp.npy --sizes ceil -o a
expect 2 'has 1 channels; expected 4' "${mips[@]}" --in ramp.npy --variant anisotropic -o a
expect 2 'has 4 channels; expected 1 for variant min' "${mips[@]}" --in volume.npy --variant min -o a
expect 2 'has 3 channels; expected 1, or 2 for pairs for variant moments' "${mips[@]}" --in flat.npy --variant moments -o a
expect 2 '--directions: up is not known; expected px, nx' "${mips[@]}" --in volume.npy --variant anisotropic --directions px,up -o a
expect 2 'format is unorm8x4; expected f32x1 for variant max' "${mips[@]}" --in ramp.npy --variant max --format unorm8 -o a
expect 2 'expected a level 0 of more than one texel' "${mips[@]}" --in one.npy -o a

# ---- Unreadable input: 2
printf 'not an image' >text.exr
cp text.exr text.hdr; cp text.exr text.png; cp text.exr text.npy
: >empty.exr; : >empty.hdr; : >empty.png; : >empty.npy
mkdir folder.npy
head -c 150 ramp.npy >short.npy
for kind in exr hdr png npy; do
  expect 2 "text\.$kind: is not a.*file" "${blur[@]}" --in "text.$kind" --sigma 1 -o a.npy
  expect 2 "empty\.$kind: is not a.*file" "${blur[@]}" --in "empty.$kind" --sigma 1 -o a.npy
done
expect 2 'missing\.npy: does not exist; check the name' "${blur[@]}" --in missing.npy --sigma 1 -o a.npy
expect 2 'folder\.npy: is not a file' "${blur[@]}" --in folder.npy --sigma 1 -o a.npy
expect 2 'short\.npy: holds 22 bytes of data; its shape \(4, 6\) of f4 needs 96' "${blur[@]}" --in short.npy --sigma 1 -o a.npy
expect 2 'Fortran order; save numpy\.ascontiguousarray' "${blur[@]}" --in fortran.npy --sigma 1 -o a.npy
expect 2 'has 1 dimensions; an image has 2' "${blur[@]}" --in line.npy --sigma 1 -o a.npy
expect 2 'has 5 channels; expected 1\.\.4' "${blur[@]}" --in wide.npy --sigma 1 -o a.npy
expect 2 'has 8 channels \(its last dimension\).*\[z\]\[y\]\[x\]\[c\]' "${mips[@]}" --in slices.npy -o a
expect 2 'has 1 dimensions' "${mips[@]}" --in line.npy -o a
expect 2 'missing\.npy: does not exist' "${mips[@]}" --in missing.npy -o a
[[ -e a || -e a.npy || -e a.jpg ]] && fail "a refused run left a file"

# ---- Output that cannot be written: 1
expect 1 'ramp\.npy/a\.npy: cannot be written; check' "${blur[@]}" --in ramp.npy --sigma 1 -o ramp.npy/a.npy
expect 1 'ramp\.npy/level_0\.npy: cannot be written; check' "${mips[@]}" --in ramp.npy -o ramp.npy

# ---- Results
expect 0 '^gaussian_blur separable f32x1 6x4, sigma 0, radius 0, clamp on cpu:float: [0-9.]+ ms; wrote same\.npy$' "${blur[@]}" --in ramp.npy --sigma 0 -o same.npy
same ramp.npy same.npy
expect 0 'sigma 10000, radius 1,' "${blur[@]}" --in ramp.npy --sigma 10000 --radius 1 -o new/folder/far.npy
[[ -s new/folder/far.npy ]] || fail "no file in new folders"
expect 0 'radius 4095' "${blur[@]}" --in ramp.npy --sigma 1300 --radius 4095 --border wrap -o mean.npy
python <<'END'
shape, v = read('mean.npy')
assert shape == (4, 6) and max(abs(x - 11.5) for x in v) <= 11.5 * 8191 * 2.0 ** -24, v  # 8191 sums in float
END
for border in clamp mirror wrap zero; do
  expect 0 "$border on" "${blur[@]}" --in flat.npy --sigma 1.5 --border "$border" --difference -o flat_out.npy
  same flat.npy flat_out.npy
done
for device in $devices cpu:double; do
  for variant in separable direct sampler; do
    expect 0 "gaussian_blur $variant f32x1 15x15, sigma 1\.5, radius 5, clamp on" "$luxel" gaussian_blur --device "$device" --variant $variant --in spike.npy --sigma 1.5 -o "spike_${device}_$variant.npy"
    python "spike_${device}_$variant.npy" "$variant" <<'END'
shape, v = read(sys.argv[1])
w = [math.exp(-0.5 * (t / 1.5) ** 2) for t in range(-5, 6)]
tolerance = 2e-3 if sys.argv[2] == 'sampler' else 1e-7  # a sampler may interpolate with few bits
for y in range(15):
    for x in range(15):
        inside = abs(x - 7) <= 5 and abs(y - 7) <= 5
        wanted = w[x - 2] * w[y - 2] / sum(w) ** 2 if inside else 0.0
        assert abs(v[y * 15 + x] - wanted) <= tolerance, (x, y, v[y * 15 + x], wanted)
END
  done
  same spike_cpu_separable.npy "spike_${device/cpu:double/cpu}_separable.npy"
  for knob in 'recursive, order 5' 'box, 3 passes' 'pyramid, 1 levels linear'; do
    variant=${knob%%,*}
    expect 0 "gaussian_blur $variant f32x1 15x15, sigma 4, ${knob#*, }, wrap on" "$luxel" gaussian_blur --device "$device" --variant "$variant" --border wrap --in spike.npy --sigma 4 -o wide.npy
    python wide.npy "$variant" <<'END'
shape, v = read(sys.argv[1])
tolerance = 0.25 if sys.argv[2] == 'box' else 0.04  # of the mean: three boxes pass 0.418 of that cosine; its harmonic has 0.007
assert abs(sum(v) - 1) <= 1e-3, sum(v)
for y in range(15):
    for x in range(15):
        # Wrapped at 15 pixels, a Gaussian of 4 is the mean and a cosine along each axis: 2 exp(-2 (pi 4 / 15)^2) = 0.491.
        wanted = (1 + 0.491 * math.cos(2 * math.pi * (x - 7) / 15)) * (1 + 0.491 * math.cos(2 * math.pi * (y - 7) / 15)) / 225
        assert abs(v[y * 15 + x] - wanted) <= tolerance / 225, (x, y, v[y * 15 + x], wanted)
END
  done
done
expect 0 'values were not finite' "${blur[@]}" --in hidden.npy --sigma 0 -o hidden.png
expect 2 'HDR files hold no alpha' "${blur[@]}" --in hidden.npy --sigma 0 -o hidden.hdr
expect 0 'f16x4' "${blur[@]}" --in flat.npy --sigma 2 --format f16 -o half.npy
expect 0 'unorm8x4' "${blur[@]}" --in flat.npy --sigma 2 --format unorm8 --drop-taps -o bytes.npy
python <<'END'
assert read('half.npy')[0] == (9, 7, 3) and max(abs(v - 0.1) for v in read('half.npy')[1]) < 2e-4
assert max(abs(v - 26 / 255) for v in read('bytes.npy')[1]) < 1e-7  # 0.1 is 25.5 steps, and 26 after rounding to even
END

for device in $devices cpu:double; do
  expect 0 'mip_build isotropic f32x1 6x4x1, 2 levels on' "$luxel" mip_build --device "$device" --in ramp.npy -o "mean_$device"
  same ramp.npy "mean_$device/level_0.npy"
  for variant in min max minmax moments gaussian3; do
    expect 0 "mip_build $variant" "$luxel" mip_build --device "$device" --variant $variant --in ramp.npy -o "${variant}_$device"
  done
  expect 0 'mip_build max.*3 levels' "$luxel" mip_build --device "$device" --variant max --sizes ceil --in ramp.npy -o "ceil_$device"
  expect 0 'mip_build anisotropic f32x4 4x4x2, 1 levels' "$luxel" mip_build --device "$device" --variant anisotropic --levels 1 --directions px,nz --in volume.npy -o "wall_$device"
  expect 0 '1 texels without opacity lost a colour.*; 1 texels with infinities' "$luxel" mip_build --device "$device" --in hidden.npy -o "hidden_$device"
  python "$device" <<'END'
import os
d = sys.argv[1]
shape, v = read('mean_%s/level_1.npy' % d)
assert shape == (2, 3) and v == (3.5, 5.5, 7.5, 15.5, 17.5, 19.5), v
assert read('mean_%s/level_2.npy' % d)[0] == (1, 1)
assert read('min_%s/level_1.npy' % d) == ((2, 3), (0.0, 2.0, 4.0, 12.0, 14.0, 16.0))
assert read('min_%s/level_2.npy' % d) == ((1, 1), (0.0,))
assert read('max_%s/level_2.npy' % d) == ((1, 1), (23.0,))
assert read('minmax_%s/level_2.npy' % d) == ((1, 1, 2), (0.0, 23.0))
assert [read('ceil_%s/level_%d.npy' % (d, l))[0] for l in range(4)] == [(4, 6), (2, 3), (1, 2), (1, 1)]
shape, v = read('moments_%s/level_1.npy' % d)
assert shape == (2, 3, 2) and v[0] == 3.5 and abs(v[1] - math.sqrt(9.25)) < 1e-6, v
assert sorted(os.listdir('wall_' + d)) == ['level_0.npy', 'level_1_nz.npy', 'level_1_px.npy'], os.listdir('wall_' + d)
assert read('wall_%s/level_1_px.npy' % d)[0] == (1, 2, 2, 4)
assert read('hidden_%s/level_1.npy' % d)[0] == (1, 1, 4)
END
  for variant in mean min max minmax moments gaussian3 ceil wall; do
    for file in "${variant}_cpu"/*.npy; do same "$file" "${variant}_${device/cpu:double/cpu}/${file##*/}"; done
  done
done

# ---- Scenes and pictures
render=("$luxel" render --method truth --size 16x9 --samples 2)
expect 2 '--scene is required' "${render[@]}" -o a.png
expect 2 '--out is required' "${render[@]}" --scene cornell
expect 2 'scene cornel is not known; expected cornell, two_rooms, furnace, atrium, pillars, curtain, atrium:N, or a file' "${render[@]}" --scene cornel -o a.png
expect 2 'scene atrium:7: 7 is no number of triangles; expected 5000\.\.500000' "${render[@]}" --scene atrium:7 -o a.png
expect 2 'missing\.obj: does not exist; check the name' "${render[@]}" --scene missing.obj -o a.png
expect 2 'folder\.npy: is not a file' "${render[@]}" --scene folder.npy -o a.png
expect 2 'text\.png: has the unknown extension \.png; expected \.obj, \.ply, \.gltf' "${render[@]}" --scene text.png -o a.png
printf 'not a mesh' >text.glb
: >empty.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >index.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >points.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n' >nan.obj
expect 2 'text\.glb: is not a mesh that assimp reads' "${render[@]}" --scene text.glb -o a.png
expect 2 'empty\.obj: is empty' "${render[@]}" --scene empty.obj -o a.png
expect 2 'index\.obj: ' "${render[@]}" --scene index.obj -o a.png
expect 2 'points\.obj: ' "${render[@]}" --scene points.obj -o a.png
expect 2 '--method: guess is not known; expected' "${render[@]}" --scene cornell --method guess -o a.png
expect 2 '--show: shadows is not known; expected all, direct' "${render[@]}" --scene cornell --show shadows -o a.png
expect 2 '--size: 16 is not understood; expected WxH' "$luxel" render --scene cornell --size 16 -o a.png
expect 2 '--size: 0x9 is not understood' "$luxel" render --scene cornell --size 0x9 -o a.png
expect 2 '--size: 8192x8192 is not understood' "$luxel" render --scene cornell --size 8192x8192 -o a.png
expect 2 '--camera: 1,2,3 is not understood; expected ex,ey,ez,tx,ty,tz,fov' "${render[@]}" --scene cornell --camera 1,2,3 -o a.png
expect 2 '--camera: .*an eye away from its target' "${render[@]}" --scene cornell --camera 1,2,3,1,2,3,40 -o a.png
expect 2 '--camera: .*below 180 degrees' "${render[@]}" --scene cornell --camera 1,2,3,0,0,0,180 -o a.png
expect 2 '--sun: 0,0,0,1 is not understood; expected a direction' "${render[@]}" --scene cornell --sun 0,0,0,1 -o a.png
expect 2 '--sky: missing\.hdr: does not exist' "${render[@]}" --scene cornell --sky missing.hdr -o a.png
expect 2 '--sky: .*expected radiances of 0 or more' "${render[@]}" --scene cornell --sky 1,-1,1 -o a.png
expect 2 '--samples: 0 is out of range' "$luxel" render --scene cornell --samples 0 -o a.png
expect 2 '--exposure: bright is not a number' "${render[@]}" --scene cornell --exposure bright -o a.png
[[ -e a.png ]] && fail "a refused render left a file"
expect 1 'ramp\.npy/a\.png: cannot be written' "${render[@]}" --scene cornell -o ramp.npy/a.png
expect 0 '^render truth nan\.obj \(2 triangles\) 16x9, all; wrote nan\.png' "${render[@]}" --scene nan.obj -o nan.png
expect 0 '^render truth cornell \(50 triangles\) 16x9, all; wrote box\.npy$' "${render[@]}" --scene cornell -o box.npy --buffers box
grep -Eq '^  build: read [0-9.]+ ms, tree [0-9.]+ ms$' out.txt || fail "render prints no build times" "$(cat out.txt)"
grep -Eq '^  shade: gbuffer .* path_truth.* compose ' out.txt || fail "render prints no shade times" "$(cat out.txt)"
expect 0 'path_truth, from the cache' "${render[@]}" --scene cornell -o box2.npy
same box.npy box2.npy
for part in direct diffuse_indirect specular_indirect ambient_occlusion; do
  expect 0 "$part; wrote" "${render[@]}" --scene cornell --show $part -o "box_$part.npy"
  [[ -s box/$part.exr ]] || fail "--buffers wrote no $part.exr"
done
for file in position normal depth albedo roughness emission truth_indirect_t1 truth_indirect_t2 truth_indirect_error; do
  [[ -s box/$file.exr ]] || fail "--buffers wrote no $file.exr"
done
expect 0 'emission' "$luxel" gaussian_blur --in box/emission.exr --sigma 0 -o box_emission.npy
expect 0 'furnace' "$luxel" render --method truth --size 16x9 --scene furnace --samples 400 --camera 0.5,1,-0.9,-0.5,0.5,0.9,70 -o furnace.npy
expect 0 'sky' "${render[@]}" --scene nan.obj --camera 0,0,-5,0,0,-9,40 --sky 1,2,3 -o sky.npy
expect 0 'sun' "${render[@]}" --scene nan.obj --camera 0.3,0.3,1,0.3,0.3,0,1 --sky 0,0,0 --sun 0,0,1,3 --bounces 1 -o sun.npy
expect 0 'png' "${render[@]}" --scene cornell --exposure -1.5 -o box.png
cone=("$luxel" render --size 32x24 --resolution 32 --scene cornell)
expect 2 '--resolution: 7 is out of range' "$luxel" render --scene cornell --resolution 7 -o cone.npy
expect 2 'count is 7; expected 1, 4, 5' "${cone[@]}" --cones 7 -o cone.npy
expect 2 "'nothing'" "${cone[@]}" --device nothing -o cone.npy
expect 0 '^render cone cornell \(50 triangles\) 32x24, all; wrote cone_first\.npy$' "${cone[@]}" --device cpu -o cone_first.npy
grep -Eq '^  update: voxel_inject .* mip_build ' out.txt || fail "render --method cone prints no update times" "$(cat out.txt)"
for device in $devices; do
  expect 0 'render cone' "${cone[@]}" --device "$device" -o "cone_$device.npy"
  same cone_first.npy "cone_$device.npy"
done
probe=("$luxel" render --method probe --size 32x24 --scene cornell --probes 3 --probe-size 16 --probe-bounces 2)
expect 2 '--probes: 0 is not understood; expected N or nx,ny,nz' "${probe[@]:0:8}" --probes 0 -o probe.npy
expect 2 '--probe-size: 15 is out of range' "${probe[@]:0:8}" --probe-size 15 -o probe.npy
expect 2 'cpu:double is not taken' "${probe[@]}" --device cpu:double -o probe.npy
expect 0 '^render probe cornell \(50 triangles\) 32x24, all; wrote probe_first\.npy$' "${probe[@]}" --device cpu -o probe_first.npy
grep -Eq '^  update: light on what is seen .* irradiance and distances .* probes lit by probes ' out.txt || fail "render --method probe prints no update times" "$(cat out.txt)"
grep -Eq '3x3x3 probes, [0-9]+ inside geometry' out.txt || fail "render --method probe does not say what it made" "$(cat out.txt)"
for device in $devices; do
  expect 0 'render probe' "${probe[@]}" --device "$device" -o "probe_$device.npy"
  same probe_first.npy "probe_$device.npy"
done
expect 0 'render probe' "${probe[@]}" --device cpu --unfiltered -o probe_unfiltered.npy
cmp -s probe_first.npy probe_unfiltered.npy && fail "--unfiltered changes nothing"

lpv=("$luxel" render --method lpv --size 32x24 --scene cornell --cells 8)
expect 2 '--cells: 3 is out of range' "${lpv[@]:0:8}" --cells 3 -o lpv.npy
expect 2 '--lobes: round is not known; expected linear, clamp' "${lpv[@]}" --lobes round -o lpv.npy
expect 2 'cpu:double is not taken' "${lpv[@]}" --device cpu:double -o lpv.npy
expect 0 '^render lpv cornell \(50 triangles\) 32x24, all; wrote lpv_first\.npy$' "${lpv[@]}" --device cpu -o lpv_first.npy
grep -Eq '^  update: maps .* lpv_inject .* lpv_propagate ' out.txt || fail "render --method lpv prints no update times" "$(cat out.txt)"
grep -Eq '8x8x8 cells of .* 8 steps, blocked by all surfaces' out.txt || fail "render --method lpv does not say what it made" "$(cat out.txt)"
for device in $devices; do
  expect 0 'render lpv' "${lpv[@]}" --device "$device" -o "lpv_$device.npy"
  same lpv_first.npy "lpv_$device.npy"
done
for change in '--blockers none' '--lobes clamp' '--steps 4' '--bands 3' '--damping 1' '--lpv-filter 0.25' '--cascades 2'; do
  expect 0 'render lpv' "${lpv[@]}" --device cpu $change -o lpv_changed.npy
  cmp -s lpv_first.npy lpv_changed.npy && fail "$change changes nothing"
done
python <<'END'
shape, total = read('box.npy')
assert shape == (9, 16, 3)
parts = [read('box_%s.npy' % p)[1] for p in ('direct', 'diffuse_indirect', 'specular_indirect', 'emission')]
worst = max(abs(sum(v) - t) / max(t, 1) for *v, t in zip(*parts, total))
assert worst <= 1e-6, worst  # the sum of four floats, rounded each
assert all(max(p) > 0 for p in parts[:3])
occlusion = read('box_ambient_occlusion.npy')
assert occlusion[0] == (9, 16) and all(0 <= v <= 1 for v in occlusion[1]) and min(occlusion[1]) < 0.9
furnace = read('furnace.npy')[1]
mean = sum(furnace) / len(furnace)
assert abs(mean - 2) <= 0.01, mean  # e / (1 - albedo); the noise of 432 x 800 paths is 0.001
assert read('sky.npy')[1] == (1.0, 2.0, 3.0) * 144
sun = read('sun.npy')[1]
assert all(abs(v - 0.6 * 3 / math.pi) < 1e-5 for v in sun), sun[:3]  # assimp's grey for OBJ faces without material
END

# ---- plan ----
expect 2 '--method: rays is not known; expected cone, probe, lpv' "$luxel" plan --scene cornell --method rays
expect 2 '--size: 0x9 is not understood' "$luxel" plan --scene cornell --size 0x9
expect 0 'no sun, no sky, nothing emits' "$luxel" plan --scene atrium:5000 --size 16x9 --sun 0,1,0,0 --sky 0,0,0 --explain
expect 0 'because the emitters are few enough to be lamps' "$luxel" plan --scene cornell --size 16x9 --explain
expect 0 'specular cones where nothing reflects' "$luxel" plan --scene two_rooms --size 16x9 --measure --resolution 8 --repeats 1 --device cpu --json plan.json
python3 - <<'END' || fail "plan --measure: leaving out is not without a trace" "$(cat plan.json)"
import json
saved = json.load(open("plan.json"))["left_out"]
assert saved and all(row["error"] == 0 for row in saved), saved
END

# ---- Meshes into voxels
voxelize=("$luxel" voxelize --resolution 16)
expect 2 '--mesh is required' "${voxelize[@]}" -o v.npy
expect 2 '--resolution is required' "$luxel" voxelize --mesh cornell -o v.npy
expect 2 '--resolution: 4096 is out of range; expected a whole number 1\.\.2048' "$luxel" voxelize --mesh cornell --resolution 4096 -o v.npy
expect 2 'missing\.obj: does not exist; check the name' "${voxelize[@]}" --mesh missing.obj -o v.npy
expect 2 '--voxel is not given; expected --origin and --voxel together' "${voxelize[@]}" --mesh cornell --origin 0,0,0 -o v.npy
expect 2 '--mode: thick is not known|thick' "${voxelize[@]}" --mesh cornell --mode thick -o v.npy
[[ -e v.npy ]] && fail "a refused voxelize left a file"
printf 'v 0.5 0.5 0.5\nv 3.5 0.5 0.5\nv 0.5 2.5 0.5\nf 1 2 3\n' >three.obj
for device in $devices; do
  expect 0 '1 triangles, 0 skipped .* 9 occupied voxels' "$luxel" voxelize --mesh three.obj --resolution 4 --origin 0,0,0 --voxel 1 --device "$device" -o "three_$device.npy" --list "list_$device.npy"
  expect 0 '2 triangles, 1 skipped \(1 not finite' "${voxelize[@]}" --mesh nan.obj --mode thin --device "$device" -o "nan_$device.npy"
  expect 0 '50 triangles, 0 skipped' "${voxelize[@]}" --mesh cornell --device "$device" --format f16 -o "cornell_$device.npy"
  for file in three list nan cornell; do same "${file}_cpu.npy" "${file}_$device.npy"; done
done
python <<'END'
shape, v = read('three_cpu.npy')
assert shape == (4, 4, 4, 4), shape
touched = [i for i in range(64) if v[4 * i + 3] > 0]
assert touched == [0, 1, 2, 3, 4, 5, 6, 8, 9], touched
b = open('list_cpu.npy', 'rb').read()
assert b"'descr': '<u4'" in b and b"'shape': (9, 4)" in b, b[:128]
rows = [struct.unpack('<4I', b[len(b) - 144 + 16 * i:][:16]) for i in range(9)]
assert rows == sorted(rows) and [r[0] + 4 * r[1] for r in sorted(rows, key=lambda r: (r[1], r[0]))] == touched, rows
assert all(r[2] == 0 and r[3] == 0 for r in rows), rows
END

# ---- Cones: fog of opacity 1/2 and radiance 1 before light 1 is 1 everywhere; a receiver without a normal is 0.
python <<'END'
write('fog.npy', (8, 8, 8, 4), [0.5] * 2048)
write('points.npy', (3, 8), [1.5, 1.5, 1.5, 0.2, 0, 1, 0, 0] + [1.5, 1.5, 1.5, 0.2, 0, 0, 0, 0] + [90, 1.5, 1.5, 0.2, 1, 0, 0, 0])
write('eyes.npy', (3, 4), [0, 1, 0, 0] * 3)
write('flat_points.npy', (3, 7), [0] * 21)
END
cones=("$luxel" cone_trace --volume fog.npy --receivers points.npy --origin 1,1,1 --voxel 0.125)
expect 2 'flat_points\.npy: has shape \[3\]\[7\]; expected \[n\]\[8\]' "$luxel" cone_trace --volume fog.npy --receivers flat_points.npy -o a.npy
expect 2 'ramp\.npy: has shape \[4\]\[6\]; expected \[z\]\[y\]\[x\]\[4\]' "$luxel" cone_trace --volume ramp.npy --receivers points.npy -o a.npy
expect 2 'cone_set aperture is .*; expected an aperture at which 6 cones' "${cones[@]}" --aperture 140 -o a.npy
expect 2 '--cones: 7 is not known; expected 1, 4, 5, 6, 8, 9, 16, 25, classic' "${cones[@]}" --cones 7 -o a.npy
expect 2 '--specular requires --views' "${cones[@]}" --specular s.npy -o a.npy
for device in $devices cpu:double; do
  for variant in isotropic anisotropic; do
    expect 0 "cone_trace $variant f32x4 8x8x8, 4 levels, 6 cones, 3 receivers.*2 receivers without a normal" "${cones[@]}" --device "$device" --variant $variant --environment 1,1,1 --views eyes.npy --specular "specular_$device.npy" -o "cones_$device.npy"
    python "$device" <<'END'
d = sys.argv[1]
shape, v = read('cones_%s.npy' % d)
assert shape == (3, 4), shape
assert all(abs(x - math.pi) < 1e-5 for x in v[0:3] + v[8:11]) and v[4:8] == (0, 0, 0, 0), v
assert 0 < v[3] < 0.2 and v[11] == 1, v
assert all(abs(x - 1) < 1e-6 for x in read('specular_%s.npy' % d)[1][0:3])
END
  done
done

# ---- Probes: of a scene, shown, and rays through them: to the back wall of the box, out of its open side, and no ray.
python <<'END'
inf = float('inf')
write('walk.npy', (3, 8), [0, 1.8, 0.5, 0, 0, 0, -2, inf] + [0, 1.8, 0.5, 0, 0, 0, 1, inf] + [0, 0, 0, 0, 0, 0, 0, 1])
write('short.npy', (3, 7), [0] * 21)
write('one_place.npy', (1, 3), [0, 0, 0])
END
expect 2 'expected either --scene, or --radiance, --distance or --normal files' "$luxel" probes build -o box
expect 2 '--grid: |ProbeGrid.count is 0; expected 1\.\.1024' "$luxel" probes build --scene cornell --grid 0,1,1 -o box
expect 2 'ProbeMaps.size is 33; expected an even number' "$luxel" probes build --scene cornell --resolution 33 -o box
expect 2 '^luxel: probes build: --resolution: 15 is out of range; .*see `luxel probes build --help`$' "$luxel" probes build --scene cornell --resolution 15 -o box
expect 0 'probes build: 8 probes in cornell, 2 inside geometry, 32\^2 texels each; wrote box' "$luxel" probes build --scene cornell --resolution 32 -o box
expect 0 'probes show: radiance of probe 7 of box, 32x32; wrote seven.png' "$luxel" probes show --probes box --probe 7 -o seven.png
expect 0 'probes show: distance of probe 0 of box \(inside geometry\), 32x32; wrote inside.png' "$luxel" probes show --probes box --map distance -o inside.png
expect 2 '--probe is 8; expected 0\.\.7' "$luxel" probes show --probes box --probe 8 -o seven.png
expect 2 'short\.npy: expected shape \[n\]\[8\]' "$luxel" probes trace --probes box --rays short.npy -o a.npy
for device in $devices cpu:double; do
  expect 0 "probes trace two_level through 8 probes 32\^2 on .*: 3 rays, 1 hit, 1 missed, 0 assumed, 0 unknown, 0 capped, 1 degenerate" "$luxel" probes trace --probes box --rays walk.npy --device "$device" -o met.npy
  python <<'END'
shape, v = read('met.npy')
assert shape == (3, 8) and v[0] == 1 and abs(v[1] - 1.5) < 1e-3 and abs(v[4] + 1) < 1e-3, v
assert v[8] == 2 and v[9] == float('inf') and v[13] == -1 and v[16] == 5, v
END
done
python <<'END'
write('even.npy', (4, 8), [2] * 32)
END
expect 0 'probes build: 1 probes of images 8x4 on .*, 16\^2 texels each; wrote even' "$luxel" probes build --radiance even.npy --distance even.npy --positions one_place.npy --resolution 16 --device cpu -o even
python <<'END'
assert all(x == 2 for x in read('even/radiance.npy')[1]) and all(x == 2 for x in read('even/distance.npy')[1])
END

# ---- bilateral
python <<'END'
w, h = 24, 16
step = [0.25 + (0.5 if x >= w // 2 else 0) + 0.01 * ((x * 7 + y * 13) % 5) for y in range(h) for x in range(w)]
write('edge.npy', (h, w), step)
write('edge3.npy', (h, w, 3), [v for v in step for c in range(3)])
write('depth.npy', (h, w), [1 if i % w < w // 2 else 1e10 for i in range(w * h)])
write('normal.npy', (h, w, 3), [v for i in range(w * h) for v in (0, 0, 1)])
write('small.npy', (2, 2), [1, 2, 3, 4])
END
filter=("$luxel" bilateral --in edge3.npy -o filtered.npy)
for device in $devices; do
  expect 0 'bilateral direct f32x4 24x16, clamp on ' "${filter[@]}" --device "$device" --sigma-space 2 --radius 4 --sigma-range 0.1 --window circle --range-norm l1
  cp filtered.npy "bilateral_$device.npy"
  same bilateral_cpu.npy "bilateral_$device.npy"
done
expect 0 '192 pixels without a surface' "${filter[@]}" --device cpu --depth depth.npy --normal normal.npy --footprint 0.01 --variant atrous --levels 2 --range off
python <<'END'
(shape, a), (_, b) = read('filtered.npy'), read('edge3.npy')
assert shape == (16, 24, 3)
sky = [i for i in range(len(a)) if i // 3 % 24 >= 12]
assert all(a[i] == b[i] for i in sky)
END
expect 0 'bilateral separable f32x1' "$luxel" bilateral --device cpu --in edge.npy --variant separable --adaptive --sigma-range 0 -o filtered.npy
same edge.npy filtered.npy
expect 0 'bilateral grid f32x4' "${filter[@]}" --device cpu --variant grid --sigma-space 4
expect 0 'bilateral discontinuity f32x4' "${filter[@]}" --device cpu --variant discontinuity --depth depth.npy --normal normal.npy
expect 2 '--variant is discontinuity; expected --depth' "${filter[@]}" --variant discontinuity
expect 0 'denoise 24x16, 3 levels' "$luxel" denoise --device cpu --color edge3.npy --albedo edge3.npy --normal normal.npy --depth depth.npy --levels 3 -o smooth.exr
expect 2 'edge\.npy: has 1 channels; --color expects 3 or more' "$luxel" denoise --color edge.npy -o smooth.exr
expect 2 'small\.npy: has 2x2 pixels; --depth expects those of --color, 24x16' "$luxel" denoise --color edge3.npy --depth small.npy -o smooth.exr
expect 2 '--levels: ' "$luxel" denoise --color edge3.npy --levels 9 -o smooth.exr
expect 2 '--range is guide; expected --guide' "${filter[@]}" --range guide
expect 2 'small\.npy: has 2x2 pixels; --depth expects those of --in, 24x16' "${filter[@]}" --depth small.npy
expect 2 'depth\.npy: has 1 channels; --normal expects 3 or more' "${filter[@]}" --normal depth.npy
expect 2 'BilateralParams\.radius is 500; expected -1\.\.96' "${filter[@]}" --radius 500
expect 2 'missing\.npy' "${filter[@]}" --guide missing.npy

# ---- Settings that are found by measuring, and promises
"$luxel" gaussian_blur --in flat.npy --sigma 0 -o image.exr >out.txt
tuned() {  # tuned STATUS HEADER ARGUMENT...: what is printed runs, and compiles
  local status=$1 header=$2 got
  shift 2
  checks=$((checks + 1))
  "$luxel" tune "$@" --quick --device cpu --json tuned.json >tuned.txt 2>err.txt
  got=$?
  [[ $got == "$status" ]] || fail "tune $*: exit status $got, expected $status" "$(cat tuned.txt err.txt)"
  [[ $status == 0 ]] || return
  [[ ! -s err.txt ]] || fail "tune $*: something on stderr" "$(cat err.txt)"
  local command
  command=$(sed -n 's/^  luxel //p' tuned.txt | head -n 1)
  # shellcheck disable=SC2086
  "$luxel" $command >out.txt 2>err.txt || fail "tune $*: its command fails: luxel $command" "$(cat err.txt)"
  sed -n '/^#include/,/^}/p' tuned.txt >tuned.cpp
  grep -q "luxel/$header" tuned.cpp || fail "tune $*: no C++" "$(cat tuned.txt)"
  if command -v g++ >/dev/null; then
    g++ -std=c++17 -Wall -Wextra -Werror -fsyntax-only -I "$root/include" tuned.cpp 2>err.txt || fail "tune $*: its C++ does not compile" "$(cat err.txt tuned.cpp)"
  fi
}
tuned 0 gaussian_blur.h gaussian_blur --sigma 2 --size 64x48 --max-error 1e-2
checks=$((checks + 1))
python3 - <<'END' || fail "tune: its JSON"
import json
t = json.load(open('tuned.json'))
a, = t['answers']
assert 0 < a['found']['error'] <= t['max_error'] == 1e-2, a
assert a['found']['row']['knobs']['sigma'] == 2 and a['found']['row']['size'] == '64x48'
assert abs(a['margin']['used'] - a['found']['error'] / 1e-2) < 1e-12
q = a['found']['time_ms']
assert 0 < q['q1'] <= q['median'] <= q['q3']
END
tuned 0 bilateral.h bilateral --radius 2 --size 64x48 --max-ms 1e6
checks=$((checks + 1))
python3 - <<'END' || fail "tune: the most exact within a time is direct itself"
import json
a, = json.load(open('tuned.json'))['answers']
assert a['found']['row']['variant'] == 'direct' and a['found']['error'] < 1e-5, a
END
tuned 1 none gaussian_blur --sigma 2 --size 64x48 --max-error 1e-12
checks=$((checks + 1))
grep -q 'none fits; nearest: .*: error ' tuned.txt && grep -q '^luxel: no setting of gaussian_blur has error at most 1e-12; the nearest stands above$' err.txt || fail "tune: what is nearest" "$(cat tuned.txt err.txt)"
expect 2 'tune: expected one of --max-error and --max-ms' "$luxel" tune gaussian_blur
expect 2 'tune: kernel is blur; expected one of: gaussian_blur, ' "$luxel" tune blur --max-ms 1
expect 2 'tune: --size is 5; expected WIDTHxHEIGHT' "$luxel" tune gaussian_blur --max-ms 1 --size 5
expect 2 'no setting of gaussian_blur fits what is asked for' "$luxel" tune gaussian_blur --max-ms 1e6 --size 16x16 --quick --device cpu --fix format=f16x2
expect 2 'expected another: the C\+\+ execution has one shape' "$luxel" tune --profile --device cpu
checks=$((checks + 1))
"$luxel" stability mip_build --quick --device cpu --only 'case opacity 1' --only 'storage: f16x4' -o certificate >out.txt 2>err.txt ||
  fail "stability: exit status" "$(cat out.txt err.txt)"
grep -q ' cases: all kept$' out.txt && grep -q '^| storage: f16x4 | ' certificate/mip_build.md || fail "stability: table and page" "$(cat out.txt certificate/mip_build.md)"
expect 2 'KERNEL is blur; expected one of' "$luxel" stability blur

# ---- Real files
if [[ -d $data/photos ]]; then
  for device in $devices; do
    expect 0 'f32x4 1000x810, sigma 4, radius 12, mirror' "$luxel" gaussian_blur --device "$device" --in "$data/photos/CandleGlass.exr" --sigma 4 --border mirror -o "candle_$device.exr"
    expect 0 'f32x4 1024x512' "$luxel" gaussian_blur --device "$device" --in "$data/hdri/vestibule_1k.hdr" --sigma 2 --border wrap -o "sky_$device.npy"
    expect 0 'f32x1 512x512' "$luxel" gaussian_blur --device "$device" --in "$data/photos/camera.png" --sigma 3 -o "camera_$device.png"
    expect 0 'minmax f32x2 512x512x1, 9 levels' "$luxel" mip_build --device "$device" --in "$data/photos/camera.png" --variant minmax -o "camera_$device"
    for file in candle_X.exr sky_X.npy camera_X.png camera_X/level_5.npy; do same "${file/X/cpu}" "${file/X/$device}"; done
  done
  expect 0 'f32x4 451x300' "$luxel" gaussian_blur --in "$data/photos/chelsea.png" --sigma 0 -o chelsea.png
  expect 0 'f32x4 451x300' "$luxel" gaussian_blur --in chelsea.png --sigma 0 -o chelsea.npy
  expect 0 'f32x4 451x300' "$luxel" gaussian_blur --in "$data/photos/chelsea.png" --sigma 0 -o chelsea2.npy
  same chelsea.npy chelsea2.npy
  expect 0 'f32x4 1000x810' "$luxel" gaussian_blur --in "$data/photos/CandleGlass.exr" --sigma 0 -o candle.npy
  expect 0 'f32x4 1000x810' "$luxel" gaussian_blur --in candle.npy --sigma 0 -o candle.exr
  expect 0 'f32x4 1000x810' "$luxel" gaussian_blur --in candle.exr --sigma 0 -o candle2.npy
  same candle.npy candle2.npy
  for file in photos/CandleGlass.exr photos/camera.png hdri/vestibule_1k.hdr opencv_ref/in_candle.npy; do
    head -c 20000 "$data/$file" >"cut.${file##*.}"
    expect 2 "cut\.${file##*.}: .*; copy or export the file again" "${blur[@]}" --in "cut.${file##*.}" --sigma 1 -o cut_out.npy
  done
  for file in "$data"/meshes_adversarial/*.{obj,ply}; do
    checks=$((checks + 1))
    timeout 20 "$luxel" render --scene "$file" --size 8x8 --samples 1 -o mesh.npy >out.txt 2>err.txt
    got=$?
    [[ $got == 0 && ! -s err.txt || $got == 2 && $(wc -l <err.txt) == 1 && $(head -c 7 err.txt) == 'luxel: ' ]] ||
      fail "render --scene $file: exit status $got" "$(cat err.txt)"
  done
  expect 0 '262267 triangles\) 16x9' "${render[@]}" --scene "$data/crytek_sponza/sponza.glb" --camera -60,8,0,60,20,0,60 --sky "$data/hdri/vestibule_1k.hdr" -o sponza.png
  expect 0 '69451 triangles, 0 skipped .* 53856 occupied voxels' "$luxel" voxelize --mesh "$data/stanford_bunny/stanford-bunny.obj" --resolution 128 --origin -0.09624699,0.030747509999999992,-0.08094349 --voxel 0.0012407264062500002 -o bunny.npy
  python "$data/numeric/vox_bunny_stanford_128.npy" <<'END'
shape, v = read('bunny.npy')
bits, n = open(sys.argv[1], 'rb').read()[128:], 128
wrong = 0
for x in range(n):
    for y in range(n):
        for z in range(n):
            i = (x * n + y) * n + z
            wrong += (bits[i >> 3] >> (7 - (i & 7)) & 1) != (v[4 * ((z * n + y) * n + x) + 3] > 0)
assert wrong == 0, wrong
END
  head -c 100000 "$data/crytek_sponza/sponza.glb" >cut.glb
  expect 2 'cut\.glb: ' "${render[@]}" --scene cut.glb -o cut_out.png
  # OpenCV's result on the same crop, with the same taps and border.
  expect 0 'radius 6, clamp' "${blur[@]}" --in "$data/opencv_ref/in_candle.npy" --sigma 2 --radius 6 -o opencv.npy
  python "$data/opencv_ref/gauss_candle_s2_k13_REPLICATE.npy" <<'END'
(shape, ours), (theirs_shape, theirs) = read('opencv.npy'), read(sys.argv[1])
assert shape == theirs_shape, (shape, theirs_shape)
worst = max(abs(a - b) for a, b in zip(ours, theirs))
assert worst <= 5e-6, worst
END
else
  echo "SKIPPED: no real files in $data; set LUXEL_DATA"
fi

echo "$checks checks, $failures failed"
[[ $failures == 0 ]]
