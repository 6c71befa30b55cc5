"""Environments of Gymnasium's shape on simulated systems: `reset` and `step`, one world or many at once.

    envs = nezumi_env.Vector("behaviors/environments/stop_at_wall.lua", 64)
    observations, infos = envs.reset(seed=1)
    observations, rewards, terminations, truncations, infos = envs.step(actions)

`Vector` is for learning: many worlds in few processes, and NumPy arrays in memory that they share. What an agent does
and sees is described in a file of Lua. `Environment` is one world with a console; it needs no file and no NumPy.

    env = nezumi_env.Environment(
        "behaviors/systems/stop_at_wall.lua",
        act='hold("mouse.target_velocity_in", { vx = action[1], va = action[2] })',
        observation="mouse.ir_sensor_out.value",
        reward="mouse.truth.velocity.vx",
        terminated="mouse.collided",
        ticks=10,
    )
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step([0.1, 0.0])

What an agent does and sees is Lua, as at the console. A step is a whole number of ticks, time passes only in it, and
the seed decides everything: the same seed and the same actions give the same episode. Gymnasium itself is not needed;
whoever has it registers these classes as they are.
"""

import contextlib
import json
import mmap
import os
import random
import subprocess

import nezumi

_STEP = """
function nezumi_step(action, ticks)
  %(act)s
  step(ticks)
  return { %(observation)s, (%(reward)s), (%(terminated)s) and true or false }
end
function nezumi_observe() return { %(observation)s } end
"""


class Environment:
    """One world. `act` is Lua that takes `action`, the others are expressions of Lua, looked at after each step.

    `ticks`: of one step. `limit`: steps after which an episode is truncated, or None. `prepare`: Lua that is run at the
    start of each episode, in which `random(lo, hi)` draws from the episode's seed. `options`: further words of `nezumi
    run`; `program`, `timeout`, `folder`: as of `nezumi.start`."""

    metadata = {"render_modes": []}
    render_mode = None
    spec = None
    reward_range = (-float("inf"), float("inf"))

    def __init__(self, file, act, observation, reward="0", terminated="false", ticks=1, limit=None, prepare="",
                 action_space=None, observation_space=None, options=(), program="nezumi", timeout=10.0, folder=None):
        self.action_space, self.observation_space = action_space, observation_space
        self._file, self._options, self._program = file, tuple(options), program
        self._timeout, self._folder = timeout, folder
        self._ticks, self._limit, self._prepare = ticks, limit, prepare
        self._lua = _STEP % {"act": act, "observation": observation, "reward": reward, "terminated": terminated}
        self._seeds = random.Random()
        self._console = self._seed = None
        self._steps = 0
        self._over = True

    @property
    def unwrapped(self):
        return self

    @property
    def console(self):
        """The console of the running world, for everything else."""
        if self._console is None:
            raise nezumi.Error("there is no world yet: call reset() first")
        return self._console

    def reset(self, *, seed=None, options=None):
        """Begins an episode: its first observation, and info with its seed. Without a `seed` it is drawn from the one
        before, so that the first seed decides all that follow. `options["prepare"]`: Lua for this episode alone."""
        if seed is not None:
            self._seeds = random.Random(seed)
        else:
            seed = self._seeds.getrandbits(31)
        if seed == self._seed and self._console is not None:
            self._console.run("restart()")
        else:
            self.close()
            self._console = nezumi.start(self._file, *self._options, seed=seed, program=self._program,
                                         timeout=self._timeout, folder=self._folder)
            self._seed = seed
            self._console.run(self._lua)
        draws = random.Random(seed)
        prepare = "\n".join(text for text in (self._prepare, (options or {}).get("prepare", "")) if text)
        if prepare:
            numbers = ",".join(repr(draws.random()) for _ in range(100))
            self._console.run("local numbers, count = {%s}, 0\nlocal function random(lo, hi) count = count + 1 "
                              "return lo + (hi - lo) * numbers[count] end\n%s" % (numbers, prepare))
        self._console.step()  # sensors have spoken once
        self._steps, self._over = 0, False
        return self._console.eval("nezumi_observe()")[0], {"seed": seed}

    def step(self, action):
        """One step: observation, reward, terminated, truncated, info."""
        return self.finish(self.begin(action))

    def begin(self, action):
        """As `step`, without waiting: `finish` takes what this returns."""
        if self._over:
            raise nezumi.Error("the episode is over: call reset()")
        return self.console.begin("nezumi_step(%s, %d)" % (nezumi.lua(action), self._ticks))

    def finish(self, number):
        observation, reward, terminated = self.console.finish(number)
        self._steps += 1
        truncated = self._limit is not None and self._steps >= self._limit
        self._over = terminated or truncated
        return observation, reward, terminated, truncated, {}

    def render(self):
        return None

    def close(self):
        """Ends the world. `reset` begins another."""
        console, self._console, self._seed, self._over = self._console, None, None, True
        if console is not None:
            console.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Environments:
    """`count` worlds at once, each in a process of its own, as Gymnasium's vector environments: lists in the place of
    single values. A world whose episode is over begins the next one in the next step, whose action it ignores."""

    def __init__(self, count, *arguments, **options):
        self.num_envs = count
        self.envs = [Environment(*arguments, **options) for _ in range(count)]
        self._begins = [True] * count
        self.single_action_space = self.envs[0].action_space
        self.single_observation_space = self.envs[0].observation_space

    def reset(self, *, seed=None, options=None):
        """World i has the seed `seed + i`."""
        results = [env.reset(seed=None if seed is None else seed + i, options=options) for i, env in enumerate(self.envs)]
        self._begins = [False] * self.num_envs
        return [observation for observation, _ in results], {"seed": [info["seed"] for _, info in results]}

    def step(self, actions):
        """Lists of observations, rewards, terminated, truncated; info."""
        if len(actions) != self.num_envs:
            raise nezumi.Error("expected %d actions, one for each world, got %d" % (self.num_envs, len(actions)))
        begun = [None if begins else env.begin(action) for env, begins, action in zip(self.envs, self._begins, actions)]
        results = []
        for env, number in zip(self.envs, begun):
            results.append(env.finish(number) if number is not None else (env.reset()[0], 0.0, False, False, {}))
        self._begins = [terminated or truncated for _, _, terminated, truncated, _ in results]
        observations, rewards, terminated, truncated, _ = (list(column) for column in zip(*results))
        return observations, rewards, terminated, truncated, {}

    def close(self):
        for env in self.envs:
            env.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Box:
    """What the values of an array may be: Gymnasium's space of this name, as far as learners read it."""

    def __init__(self, low, high):
        self.low, self.high, self.shape, self.dtype = low, high, low.shape, low.dtype

    def contains(self, values):
        return values.shape == self.shape and bool(((values >= self.low) & (values <= self.high)).all())

    def __repr__(self):
        return "Box(%s, %s, %s)" % (self.low.min(), self.high.max(), self.shape)


class Vector:
    """`num_envs` worlds of an environment's file, in `processes` processes (default: one a processor core).

    Arrays have the worlds as rows. A world whose episode is over begins the next one in the next step, whose action it
    ignores. `copy=False`: the arrays that are returned are the shared memory, which the next call changes."""

    metadata = {"autoreset_mode": "NextStep", "render_modes": []}
    render_mode = None
    spec = None

    def __init__(self, file, num_envs=1, processes=None, copy=True, program="nezumi", folder=None):
        try:
            import numpy
        except ImportError:
            raise nezumi.Error("nezumi_env.Vector needs NumPy: sudo apt install python3-numpy") from None
        self._numpy, self._copy, self.num_envs = numpy, copy, num_envs
        if num_envs < 1:
            raise nezumi.Error("expected at least 1 world, got %d" % num_envs)
        if processes is None:
            processes = len(os.sched_getaffinity(0))
        processes = max(1, min(processes, num_envs))
        self._is_seeded = False
        self._processes = []
        bounds = [num_envs * i // processes for i in range(processes + 1)]
        self._firsts = bounds[:-1]
        memory = os.memfd_create("nezumi worlds", 0)
        try:
            for first, end in zip(bounds, bounds[1:]):
                words = [program, "environment", str(file), "--memory", str(memory), "--worlds", str(num_envs),
                         "--first", str(first), "--count", str(end - first)]
                self._processes.append(self._start(words, memory, folder))
            said = [self._answer(process) for process in self._processes]
            for each in said:
                if "error" in each:
                    raise nezumi.Error(each["error"])
            self._map(said[0], memory)
        except BaseException:
            self.close()
            raise
        finally:
            os.close(memory)

    @staticmethod
    def _start(words, memory, folder):
        # A session of its own: Ctrl-C is for the learner, whose end closes the pipes.
        return subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                pass_fds=(memory,), cwd=folder, start_new_session=True)

    def _map(self, said, memory):
        numpy = self._numpy
        self._memory = mmap.mmap(memory, said["bytes"])
        self.arrays = {
            name: numpy.frombuffer(self._memory, place["type"], int(numpy.prod(place["shape"])),
                                   place["offset"]).reshape(place["shape"])
            for name, place in said["arrays"].items()}
        self.description = said
        self.single_action_space = self._space(said["action"])
        self.single_observation_space = self._space(said["observation"])
        self.action_space = self._of_all(self.single_action_space)
        self.observation_space = self._of_all(self.single_observation_space)

    def _space(self, channels):
        def limits(name, otherwise):
            values = [channel.get(name, otherwise) for channel in channels for _ in range(channel["count"])]
            return self._numpy.array(values, "f4")
        return Box(limits("min", -float("inf")), limits("max", float("inf")))

    def _of_all(self, space):
        rows = (self.num_envs, 1)
        return Box(self._numpy.tile(space.low, rows), self._numpy.tile(space.high, rows))

    def _answer(self, process):
        line = process.stdout.readline()
        return json.loads(line) if line else {"error": "a process with worlds has ended"}

    def _all(self, line, of=None):
        if not self._processes:
            raise nezumi.Error("the worlds are closed")
        chosen = self._processes if of is None else [self._processes[of]]
        for process in chosen:
            with contextlib.suppress(BrokenPipeError):  # then there is no answer
                process.stdin.write(line.encode() + b"\n")
                process.stdin.flush()
        errors = [answer["error"] for answer in map(self._answer, chosen) if "error" in answer]
        if errors:
            raise nezumi.Error(errors[0])

    def _taken(self, name):
        array = self.arrays[name]
        if array.dtype == self._numpy.uint8:
            array = array.view(bool)
        return array.copy() if self._copy else array

    @property
    def unwrapped(self):
        return self

    def reset(self, *, seed=None, options=None):
        """Begins an episode in each world: the first observations, and infos with the seeds. World i has the seed
        `seed + i`; without a `seed` it follows from the one before. `options` must be empty."""
        if options:
            raise nezumi.Error("there are no options: the environment's file says how an episode starts")
        if seed is None and not self._is_seeded:
            seed = random.getrandbits(31)
        self._is_seeded = True
        self._all("reset" if seed is None else "reset %d" % seed)
        return self._taken("observations"), {"seed": self._taken("seeds")}

    def step(self, actions):
        """One step of all worlds: observations, rewards, terminations, truncations, infos. Actions are kept within
        their limits."""
        self.arrays["actions"][...] = self._numpy.reshape(actions, self.arrays["actions"].shape)
        self._all("step")
        return (self._taken("observations"), self._taken("rewards"), self._taken("terminated"),
                self._taken("truncated"), {})

    def seeds(self):
        """Of the present episodes."""
        return self._taken("seeds")

    def reload(self):
        """Episodes that begin from now on use the environment's file as it is now."""
        self._all("reload")

    def save_episode(self, world, file):
        """Writes the journal of a world's episode up to now; `nezumi open FILE` shows it in the time line."""
        if not 0 <= world < self.num_envs:
            raise nezumi.Error("there is no world %d: expected 0 to %d" % (world, self.num_envs - 1))
        of = max(i for i, first in enumerate(self._firsts) if first <= world)
        self._all("save %d %s" % (world, os.path.abspath(file)), of)

    def close(self):
        for process in self._processes:
            with contextlib.suppress(BrokenPipeError):
                process.stdin.close()
            process.stdout.close()
            process.wait()
        self._processes = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
