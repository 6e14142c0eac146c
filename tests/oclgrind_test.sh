#!/usr/bin/env bash
# Runs small cases of every kernel in Oclgrind, which checks each memory access and looks for data races.
# Usage: oclgrind_test.sh FOLDER with the test programs. Fails on any report, and where a filter selects no test.
set -u
cd "$1" || exit 2
command -v oclgrind >/dev/null || { echo "oclgrind is missing: apt-get install oclgrind" >&2; exit 1; }
log=$(mktemp -d)
trap 'rm -rf "$log"' EXIT
failed=0
check() {
  local program=$1 filter=$2
  LUXEL_BACKENDS=opencl LUXEL_CACHE=$log/cache oclgrind --data-races --log "$log/report" \
    "./$program" --gtest_filter="$filter" >"$log/out" 2>&1
  local status=$?
  if [ $status -ne 0 ] || [ -s "$log/report" ] || ! grep -qE '^\[  PASSED  \] [1-9]' "$log/out"; then
    echo "$program $filter: status $status"
    head -n 20 "$log/report" 2>/dev/null
    grep -vE '^\[ (RUN|      OK)' "$log/out" | tail -n 20
    failed=1
  else
    echo "$program $filter: $(grep -E '^\[  PASSED' "$log/out")"
  fi
}
check probe_test '*'
check gaussian_blur_test 'GaussianBlurSmall*'
check bilateral_test 'BilateralSmall.Packed*'
check mip_build_test 'MipBuild/Formula*:MipBuild.ThreeLevels*'
check voxelize_test 'VoxelizeSmall*'
check voxelize_device_test 'VoxelizeDevice.Textures*:VoxelizeDevice.AFloor*'
check voxelize_over_test 'VoxelizeOverSmall*'
check voxelize_window_test 'Voxelize.AWindowHolds*:VoxelizeWindowSmall*'
check voxel_inject_test 'VoxelInject.SameBits*:VoxelInject.AWindow*'
check voxel_inject_map_test 'VoxelInjectMap.BadTexels*:VoxelInjectMap.LightsAndAMap*:VoxelInjectMap.WhereAMap*'
check cone_trace_test 'ConeTraceSmall*:ConeTrace.TurnedSets*:ConeTrace.ASky*'
check light_propagation_step_test 'LightPropagation/LpvStep.*1x1x1*:LightPropagation/LpvStep.*16x1x2*'
check light_propagation_test 'LightPropagationSmall*'
check bilateral_stability_test '*opencl*one_NaN*:*opencl_NaN_and_infinity*:*opencl_flat_tiles_of_a_constant*'
check octahedral_march_map_test '*NoDirection*:*AxesAre*'
check cone_trace_clipmap_test 'ConeTraceClipmap.AMoved*'
check octahedral_march_stability_test '*opencl_rays_inside*:*opencl_rays_along*:*opencl_all_eight_hidden__plus3*'
check octahedral_march_build_test 'ProbeBuild.MinimumIs*'
check hiz_ssr_test 'HizSsrSmall*'
check lpv_stability_test '*opencl*order*:*opencl_sample__receivers_outside*:*opencl_sample__f16x4__damping*:*opencl_filter__an_impulse*'
check lpv_inject_test 'LpvSample.Writes*'
check light_propagation_energy_test '*OneCell'
check probe_stability_test '*opencl*furnace*:*opencl*hidden*'
check probe_irradiance_test 'ProbeIrradiance.ProbesThatAreNotListed*:ProbeIrradiance.BordersHold*'
exit $failed
