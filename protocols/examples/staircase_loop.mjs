// Two interleaved staircases in an experiment of your own, for Node: `heft procedure` writes a JSON
// object a line, and reads one for each trial. Any language with pipes can do this.
//
//     node staircase_loop.mjs
//
// The program is "heft" on the PATH, or the path in HEFT.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";

// `heft procedure --help-all` lists the keys. Levels are differences in g.
const settings = `
seed = 1
[[staircase]]
name = "15g"
start = 175
step = 50
halve_every = 2
floor = 0
[[staircase]]
name = "65g"
start = 200
step = 50
halve_every = 2
floor = 0
`;
const folder = mkdtempSync(join(tmpdir(), "heft-"));
const file = join(folder, "staircases.toml");
writeFileSync(file, settings);

const heft = spawn(process.env.HEFT ?? "heft", ["procedure", file], {
  stdio: ["pipe", "pipe", "inherit"],
});
heft.on("error", (error) => console.error(`cannot start heft: ${error.message}`));
heft.on("close", (code) => {
  rmSync(folder, { recursive: true });
  process.exitCode = code ?? 1;
});

for await (const line of createInterface({ input: heft.stdout })) {
  const event = JSON.parse(line);
  if (event.event === "trial") {
    // Here you present event.level and ask. This observer perceives more than 62 g.
    const response = event.level > 62;
    console.log(event.trial, event.staircase, `${event.level} g`, response);
    heft.stdin.write(JSON.stringify({ response }) + "\n");
  } else if (event.event === "finished") {
    console.log(`${event.staircase}: ${event.estimate} g after ${event.n_trials} trials`);
  } else if (event.event === "error") {
    console.error(event.message);
  }
}
