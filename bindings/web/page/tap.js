// Reads the output of `nezumi test`: its report (--tap), also an incomplete one, and its coverage.

/// [{ file, name, state, message, lines, folder }, ...]: `lines` are the margins of a passed run, or the details of a failed
/// one; `folder` has the files of a failed run.
export function read_report(text) {
  const results = [];
  let in_details = false;
  for (const line of text.split("\n")) {
    const found = /^(not )?ok \d+ - ([^:]+): (.*?)( # SKIP.*)?$/.exec(line);
    const last = results.at(-1);
    if (found) results.push({ file: found[2], name: found[3], state: found[4] ? "skipped" : found[1] ? "failed" : "passed", message: "", lines: [], folder: "" });
    else if (/^# seed \d+, /.test(line)) break;  // the rest of the report is about all scenarios
    else if (!last) continue;
    else if (line === "  ---") in_details = true;
    else if (line === "  ...") in_details = false;
    else if (in_details && line.startsWith("  message: ")) last.message = unquoted(line.slice(11));
    else if (in_details && line.startsWith("    - ")) {
      const detail = unquoted(line.slice(6));
      const kept = /^files: (\S+)/.exec(detail);
      if (kept) last.folder = kept[1];
      last.lines.push(detail);
    } else if (line.startsWith("# ")) last.lines.push(line.slice(2));
  }
  return results;
}

/// Reads an lcov file of `nezumi test --coverage`: file to Map of line to the number of runs.
export function read_coverage(text) {
  const files = new Map();
  let lines = new Map();
  for (const row of text.split("\n")) {
    const [, file, line, runs] = /^(?:SF:(.*)|DA:(\d+),(\d+))$/.exec(row) ?? [];
    if (file) files.set(file, lines = files.get(file) ?? new Map());
    else if (line) lines.set(Number(line), (lines.get(Number(line)) ?? 0) + Number(runs));
  }
  return files;
}

function unquoted(text) {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}
