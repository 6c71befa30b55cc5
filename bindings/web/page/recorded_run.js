// A recorded run, as `nezumi share --light` writes it. Values are rows [frame, number, ...], each valid until the next row.

const MOST_ROWS = 1500;  // most rows of a time line

/// The last row at or before a frame.
function row_at(rows, frame) {
  let [low, high] = [0, rows.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rows[middle][0] <= frame) low = middle + 1;
    else high = middle;
  }
  return rows[low - 1];
}

const pose_of = ([, x, y, z, r, p, yaw]) => ({ position: { x, y, z }, orientation: { r, p, y: yaw } });

export class RecordedRun {
  #run;

  constructor(run) {
    this.#run = run;
  }

  get hello() {
    return this.#run.hello;
  }

  get log() {
    return this.#run.log;
  }

  get floor() {
    return this.#run.floor;
  }

  get last() {
    return this.#run.times.length - 1;
  }

  time = (frame) => this.#run.times[frame];

  /// The number of the last frame at or before a time [s].
  frame_at(time) {
    const { times } = this.#run;
    let [low, high] = [0, times.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time + 1e-6) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  /// The number of the description of the system that is valid at a frame.
  system_number = (frame) => Math.max(0, this.#run.systems.findLastIndex((each) => each.frame <= frame));
  system = (frame) => this.#run.systems[this.system_number(frame)].system;

  #all(tracks, frame, make) {
    return Object.entries(tracks).map(([index, rows]) => [Number(index), row_at(rows, frame)]).filter(([, row]) => row).map(([index, row]) => make(index, row));
  }

  /// The poses of all objects at a frame, in the form of the engine's frames.
  state(frame) {
    const { robots, things, markers, rays, touched } = this.#run;
    return {
      robots: this.#all(robots, frame, (index, [, x, y, z, yaw, pitch, roll, collided, touches]) =>
        ({ index, x, y, z, yaw, pitch, roll, is_truth: true, collided: collided === 1, touches: touched[touches], contacts: [] })),
      things: this.#all(things, frame, (index, row) => ({ index, pose: pose_of(row) })),
      markers: this.#all(markers, frame, (index, row) => ({ index, pose: pose_of(row) })),
      rays: this.#all(rays, frame, (robot, row) => Array.from({ length: (row.length - 1) / 8 }, (_, i) => {
        const [x, y, z, a, b, c, hit, distance] = row.slice(1 + 8 * i, 9 + 8 * i);
        return { robot, from: { x, y, z }, to: { x: a, y: b, z: c }, hit: hit === 1, distance };
      })).flat(),
    };
  }

  /// The value of a port or a member at a frame by the paths of its numbers, or undefined.
  value(name, frame) {
    const track = this.#run.values[name];
    const row = track && row_at(track.rows, frame);
    if (!row) return undefined;
    const { leaves } = track;
    if (leaves.length === 1 && leaves[0] === "") return row[1];
    if (leaves.every((leaf) => /^\[\d+\]$/.test(leaf))) return row.slice(1);
    return Object.fromEntries(row.slice(1).map((number, i) => [leaves[i], number]));
  }

  /// Rows [time, value, ...] of the fields { port, path } over the whole run.
  rows_of(fields) {
    const tracks = fields.map(({ port, path }) => {
      const track = this.#run.values[port];
      return { rows: track?.rows ?? [], column: track ? track.leaves.indexOf(path) : -1 };
    });
    return this.#run.times.map((time, frame) => [time, ...tracks.map(({ rows, column }) => (column < 0 ? null : row_at(rows, frame)?.[column + 1] ?? null))]);
  }

  /// The history of the branch in the form in which an engine sends it, for the time line.
  remembered(branch) {
    const { times, robots, things, marks } = this.#run;
    const tracks = Object.values(robots);
    const step = Math.ceil(times.length / MOST_ROWS);
    const rows = times.map((time, frame) => [time, frame]).filter(([, frame]) => frame % step === 0 || frame === this.last)
      .map(([time, frame]) => [time, ...tracks.flatMap((track) => {
        const [, x, y, , yaw] = row_at(track, frame) ?? track[0];
        return [x, y, yaw];
      })]);
    const moved = Object.entries(things).flatMap(([index, all]) => (all.length < 2 ? [] : all.map(([frame, ...pose]) => [times[frame], Number(index), ...pose])));
    return { is: "remembered", branch, marks, rows, things: moved.sort((a, b) => a[0] - b[0]) };
  }
}
