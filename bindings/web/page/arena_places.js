// Finds free places for a new thing in the arena, seen from above.

/// The objects in the arena as functions (x, y), which return the distance [m] from a point to the object; 0 or less
/// inside it.
export function standing({ robots, things, markers }, scene) {
  const round = (pose, radius) => pose && ((x, y) => Math.hypot(x - pose.x, y - pose.y) - radius);
  const box = (pose, [l, w]) => pose && ((x, y) => {
    const [dx, dy] = [x - pose.x, y - pose.y];
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    return Math.hypot(Math.max(0, Math.abs(dx * cos + dy * sin) - l / 2), Math.max(0, Math.abs(dy * cos - dx * sin) - w / 2));
  });
  return [
    ...robots.map((pose, i) => round(pose, (scene.sizes[i] ?? 0.1) / 2)),
    ...scene.thing_specs.map(({ size }, i) => box(scene.thing_pose(things, i), size)),
    ...scene.marker_specs.map(({ size }, i) => round(scene.marker_pose(markers, i), size / 2)),
  ].filter(Boolean);
}

/// The area that a new thing covers, as circles [x, y, radius] relative to its place. `robot`: the radius of a robot.
export function outline_of(word, robot) {
  if (word === "wall") return [-0.2, -0.15, -0.1, -0.05, 0, 0.05, 0.1, 0.15, 0.2].map((y) => [0, y, 0.03]);
  return [[0, 0, { box: 0.071, cylinder: 0.05, marker: 0.05, robot }[word]]];
}
