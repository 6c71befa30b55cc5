// Exports a plot: CSV for spreadsheets, SVG for documents.
import { T } from "./texts.js";

const quoted = (text) => (/[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

/// The format of `--record`: a column of time and one for each name; empty without a value.
export function to_csv(names, rows) {
  const number = (value) => (value === null ? "" : String(Number(value.toPrecision(9))));
  return [["time", ...names.map(quoted)].join(","), ...rows.map((row) => row.map(number).join(","))].join("\n") + "\n";
}

/// Round numbers from low to high, about `count` of them.
export function ticks(low, high, count) {
  const rough = (high - low || 1) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((each) => each * power >= rough);
  const found = [];
  for (let i = Math.ceil(low / step); i * step <= high + step * 1e-9; ++i) found.push(Number((i * step).toPrecision(10)));
  return found;
}

export function to_svg(names, rows, colors) {
  const [w, h, left, top, right, bottom] = [900, 420, 64, 20 + 18 * names.length, 20, 44];
  const times = rows.map(([time]) => time);
  const values = rows.flatMap((row) => row.slice(1)).filter((value) => value !== null);
  const [t0, t1] = [times[0] ?? 0, times[times.length - 1] ?? 1];
  const [v0, v1] = [Math.min(0, ...values), Math.max(0, ...values)];
  const [low, high] = v0 === v1 ? [v0 - 1, v1 + 1] : [v0, v1];
  const x = (t) => left + ((t - t0) / (t1 - t0 || 1)) * (w - left - right);
  const y = (v) => h - bottom - ((v - low) / (high - low)) * (h - top - bottom);
  const text = (px, py, words, more = "") => `<text x="${px}" y="${py}" ${more}>${escaped(words)}</text>`;
  const parts = [
    ...ticks(t0, t1, 8).map((t) => `<path class="g" d="M${x(t).toFixed(1)} ${top}V${h - bottom}"/>` + text(x(t).toFixed(1), h - bottom + 18, String(t), 'text-anchor="middle"')),
    ...ticks(low, high, 6).map((v) => `<path class="g" d="M${left} ${y(v).toFixed(1)}H${w - right}"/>` + text(left - 8, (y(v) + 4).toFixed(1), String(v), 'text-anchor="end"')),
    text((left + w - right) / 2, h - 8, T.plots.time, 'text-anchor="middle"'),
    ...names.map((name, i) => {
      let pen = "M";
      const path = rows.map((row) => {
        if (row[i + 1] === null) return (pen = "M", "");
        const point = `${pen}${x(row[0]).toFixed(1)} ${y(row[i + 1]).toFixed(1)}`;
        pen = "L";
        return point;
      }).join("");
      return `<path fill="none" stroke="${colors[i]}" stroke-width="1.6" d="${path}"/>` +
        `<path stroke="${colors[i]}" stroke-width="3" d="M${left} ${14 + 18 * i}h18"/>` + text(left + 26, 18 + 18 * i, name);
    }),
  ];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${w} ${h}" font-family="sans-serif" font-size="12">` +
    `<style>.g{stroke:#ccc;stroke-width:.6}</style><rect width="${w}" height="${h}" fill="#fff"/>${parts.join("")}</svg>\n`;
}
