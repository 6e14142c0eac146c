// How many workgroups walk a list whose length is found on the device.

// For `count` items, one an invocation, and never more than `most`: beyond that invocations take several, a stride apart.
FN uint groups_for(uint count, uint workgroup, uint most) {
    return min(count / workgroup + (count % workgroup != 0u ? 1u : 0u), most);
}
