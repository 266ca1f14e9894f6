// What the camera covers of the building as it is known: its field of view up to the walls, and on through open doors.

const RAYS = 48;
const WALL_M = 0.4;
const STEP_M = 1e-3;

// Corners of the part of the map that is covered. `pose`: { x, y, yaw_rad } of the robot, `camera`: where it looks, in the
// robot's frame; `rooms` and `doors`: nodes of the graph. Furniture hides nothing here.
export function covered(pose, camera, rooms, doors) {
  const [c, s] = [Math.cos(pose.yaw_rad), Math.sin(pose.yaw_rad)];
  const eye = [pose.x + c * camera.x - s * camera.y, pose.y + s * camera.x + c * camera.y];
  const walls = rooms.flatMap(({ polygon_m }) => polygon_m.map((corner, i) => [corner, polygon_m[(i + 1) % polygon_m.length]]));
  const gaps = doors.filter(({ state, width_m }) => state !== "closed" && width_m);
  const first = pose.yaw_rad + camera.yaw_rad - camera.width_rad / 2;
  const ends = Array.from({ length: RAYS + 1 }, (_, i) => reach(eye, first + (i / RAYS) * camera.width_rad, camera.range_m, walls, gaps));
  return [eye, ...ends];
}

function reach([x, y], angle, range_m, walls, gaps) {
  const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
  const at = (t) => [x + t * dx, y + t * dy];
  const hits = walls.map((wall) => distance([x, y], [dx, dy], wall)).filter((t) => t > STEP_M && t < range_m).sort((a, b) => a - b);
  return at(hits.find((t) => !gaps.some((gap) => isIn(gap, at(t)))) ?? range_m);
}

// How far along the ray the wall is; infinite where they do not meet.
function distance([x, y], [dx, dy], [[ax, ay], [bx, by]]) {
  const [ex, ey] = [bx - ax, by - ay], across = dx * ey - dy * ex;
  if (Math.abs(across) < 1e-9) return Infinity;
  const t = ((ax - x) * ey - (ay - y) * ex) / across, u = ((ax - x) * dy - (ay - y) * dx) / across;
  return u >= 0 && u <= 1 ? t : Infinity;
}

function isIn({ position_m: [x, y], yaw_rad = 0, width_m }, [px, py]) {
  const [c, s] = [Math.cos(yaw_rad), Math.sin(yaw_rad)];
  return Math.abs((px - x) * c + (py - y) * s) <= width_m / 2 && Math.abs((py - y) * c - (px - x) * s) <= WALL_M;
}
