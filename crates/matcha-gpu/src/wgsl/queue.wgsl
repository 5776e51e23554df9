// Numbers of workgroups for indirect dispatches.

// Workgroups of WORKGROUP invocations for `count` of them, in rows.
fn workgroups_for(count: u32) -> vec3u {
    let groups = (count + WORKGROUP - 1u) / WORKGROUP;
    return vec3u(min(groups, WORKGROUP_COLUMNS), (groups + WORKGROUP_COLUMNS - 1u) / WORKGROUP_COLUMNS, 1u);
}
