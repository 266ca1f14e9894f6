// Where to write a name so that it covers as little as possible. Boxes are [left, top, right, bottom] in meters, y down.

const overlap = (a, b) => Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) * Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));
const around = ([x, y], w, h) => [x - w / 2, y - h / 2, x + w / 2, y + h / 2];
const STEPS = [0, -0.16, 0.16, -0.32, 0.32, -0.42, 0.42];
const STAY = 0.06;

// A name moves only when that uncovers much, so that it does not dance while things are being found.
export class LabelPlaces {
  #before = new Map(); #taken = [];

  start(obstacles) { this.#taken = [...obstacles]; }

  // The center for a text of `w` × `h` meters inside `area`; `null` when it does not fit there.
  place(key, area, w, h) {
    const [width, height] = [area[2] - area[0], area[3] - area[1]];
    if (w > width * 1.05 || h > height * 1.05) return null;
    const center = [(area[0] + area[2]) / 2, (area[1] + area[3]) / 2];
    const inside = ([x, y]) => [Math.min(Math.max(x, area[0] + w / 2), area[2] - w / 2), Math.min(Math.max(y, area[1] + h / 2), area[3] - h / 2)];
    const spots = STEPS.flatMap((dy) => STEPS.map((dx) => inside([center[0] + dx * width, center[1] + dy * height])));
    const cost = (spot) => this.#taken.reduce((sum, box) => sum + overlap(around(spot, w, h), box), 0) / (w * h)
      + 0.3 * Math.hypot((spot[0] - center[0]) / width, (spot[1] - center[1]) / height);
    const costs = spots.map(cost);
    let best = costs.indexOf(Math.min(...costs));
    const before = this.#before.get(key);
    if (before !== undefined && costs[before] < costs[best] + STAY) best = before;
    this.#before.set(key, best);
    this.#taken.push(around(spots[best], w, h));
    return spots[best];
  }
}
