// The map frame is turned as the robot stood when it first started; on the screen, walls shall be upright.

// Angle in radians, at most an eighth of a turn, by which most of the walls are turned against the axes.
export function tiltOf(rooms) {
  let [c, s] = [0, 0];
  for (const { polygon_m } of rooms) {
    polygon_m.forEach(([x, y], i) => {
      const [dx, dy] = [polygon_m[(i + 1) % polygon_m.length][0] - x, polygon_m[(i + 1) % polygon_m.length][1] - y];
      const angle = 4 * Math.atan2(dy, dx), length = Math.hypot(dx, dy);
      c += length * Math.cos(angle);
      s += length * Math.sin(angle);
    });
  }
  return Math.atan2(s, c) / 4;
}

export class Turn {
  #c; #s; #angle;

  constructor(angle) { [this.#angle, this.#c, this.#s] = [angle, Math.cos(angle), Math.sin(angle)]; }

  get angle() { return this.#angle; }

  point([x, y]) { return [this.#c * x + this.#s * y, this.#c * y - this.#s * x]; }

  node(node) {
    const turned = { ...node, position_m: this.point(node.position_m), yaw_rad: (node.yaw_rad ?? 0) - this.#angle };
    if (node.polygon_m) turned.polygon_m = node.polygon_m.map((corner) => this.point(corner));
    return turned;
  }

  robot(robot) {
    const [x, y] = this.point([robot.pose_map.x, robot.pose_map.y]);
    return { ...robot, pose_map: { x, y, yaw_rad: robot.pose_map.yaw_rad - this.#angle }, path_map: robot.path_map?.map((spot) => this.point(spot)) };
  }
}
