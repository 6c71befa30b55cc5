"""Many worlds of an environment's file as arrays of NumPy: vector_test.py NEZUMI."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path.insert(0, os.path.join(ROOT, "bindings", "python"))

import numpy  # noqa: E402

import nezumi  # noqa: E402
import nezumi_env  # noqa: E402

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "nezumi"
PROGRAM = os.path.abspath(PROGRAM) if os.path.exists(PROGRAM) else PROGRAM

SYSTEM = """
local away = argument("wall", 0.5, { min = 0.3, max = 2 })
arena { wall { from = { away, -1 }, to = { away, 1 } } }
robot "mouse" { model = "raspimouse", noise = 0.01 }
"""
ENVIRONMENT = """
local steps = 0
environment {
  system = "wall",
  ticks = 5,
  limit = 8,
  action = { { "speed", min = 0, max = 0.5 }, "turn" },
  observation = { { "ranges", count = 4 }, "x", "collided" },
  start = function() return { wall = 0.4 + 0.3 * math.random() } end,
  reset = function(world) world.mouse:teleport { x = 0.05 * math.random(), y = 0, heading = 0 } end,
  act = function(world, action)
    steps = steps + 1
    world.mouse.target_velocity_in:hold { vx = action[1], va = action[2] }
  end,
  observe = function(world)
    return { world.mouse.ir_sensor_metre_out.value, world.mouse.truth.pose.position.x, world.mouse.collided }
  end,
  reward = function(world, action) return steps + action[1] end,
  terminated = function(world) return world.mouse.collided end,
}
"""


class VectorTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        os.makedirs(os.path.join(self.folder, "behaviors", "systems"))
        self.write("behaviors/systems/wall.lua", SYSTEM)
        self.write("behaviors/wall_env.lua", ENVIRONMENT)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)

    def vector(self, worlds, **words):
        envs = nezumi_env.Vector("behaviors/wall_env.lua", worlds, program=PROGRAM, folder=self.folder, **words)
        self.addCleanup(envs.close)
        return envs

    def refused(self, action, *arguments, **words):
        with self.assertRaises(nezumi.Error) as raised:
            action(*arguments, **words)
        return str(raised.exception)

    def run_of(self, envs, seed, steps=20, speed=0.3):
        """All that some steps give, in one array a kind."""
        all_ = [envs.reset(seed=seed)[0]]
        for i in range(steps):
            all_.extend(envs.step([[speed, 0.1 * (i % 3)]] * envs.num_envs)[:4])
        return all_ + [envs.seeds()]

    def test_spaces_and_arrays_have_the_shapes_of_the_file(self):
        envs = self.vector(3)
        self.assertEqual(envs.single_action_space.shape, (2,))
        self.assertEqual(envs.single_observation_space.shape, (6,))
        self.assertEqual(envs.action_space.shape, (3, 2))
        numpy.testing.assert_array_equal(envs.single_action_space.low, numpy.array([0, -numpy.inf], "f4"))
        numpy.testing.assert_array_equal(envs.single_action_space.high, numpy.array([0.5, numpy.inf], "f4"))
        observations, infos = envs.reset(seed=5)
        self.assertEqual((observations.shape, observations.dtype), ((3, 6), numpy.dtype("f4")))
        self.assertEqual(list(infos["seed"]), [5, 6, 7])
        observations, rewards, terminations, truncations, infos = envs.step(numpy.zeros((3, 2)))
        self.assertEqual((rewards.dtype, terminations.dtype, truncations.dtype), (numpy.dtype("f8"), bool, bool))
        self.assertEqual((rewards.shape, terminations.shape), ((3,), (3,)))

    def test_the_seed_decides_everything_whatever_the_number_of_processes_and_worlds(self):
        one, two = self.run_of(self.vector(4, processes=1), 7), self.run_of(self.vector(4, processes=3), 7)
        for a, b in zip(one, two):
            numpy.testing.assert_array_equal(a, b)
        alone = self.run_of(self.vector(1), 9)
        for a, b in zip(one, alone):
            numpy.testing.assert_array_equal(a[2], b[0])
        other = self.run_of(self.vector(4), 70)
        self.assertFalse(numpy.array_equal(one[0], other[0]))

    def test_an_episode_is_truncated_at_its_limit_and_the_next_step_begins_another(self):
        envs = self.vector(1)
        envs.reset(seed=1)
        for _ in range(7):
            _, rewards, terminations, truncations, _ = envs.step([[0, 0]])
            self.assertFalse(terminations[0] or truncations[0])
        _, rewards, terminations, truncations, _ = envs.step([[0, 0]])
        self.assertEqual((rewards[0], terminations[0], truncations[0]), (8, False, True))
        first = envs.seeds()[0]
        _, rewards, terminations, truncations, _ = envs.step([[0.5, 0]])
        self.assertEqual((rewards[0], terminations[0], truncations[0]), (0, False, False))
        self.assertNotEqual(envs.seeds()[0], first)
        _, rewards, _, _, _ = envs.step([[0, 0]])
        self.assertEqual(rewards[0], 1)  # the file's own variables begin again, too

    def test_an_episode_that_ends_early_is_terminated(self):
        self.write("behaviors/wall_env.lua", ENVIRONMENT.replace("limit = 8", "limit = 500"))
        envs = self.vector(2)
        envs.reset(seed=1)
        for _ in range(400):
            observations, _, terminations, truncations, _ = envs.step([[0.5, 0], [0, 0]])
            if terminations[0]:
                break
        self.assertEqual((list(terminations), list(truncations)), ([True, False], [False, False]))
        self.assertEqual(list(observations[:, 5]), [1, 0])

    def test_actions_are_kept_within_their_limits(self):
        envs = self.vector(2)
        envs.reset(seed=1)
        _, rewards, _, _, _ = envs.step([[9, 0], [-9, 0]])
        self.assertEqual(list(rewards), [1.5, 1])
        self.assertEqual(self.refused(envs.step, [[0, 0], [float("nan"), 0]]), "world 1: action 'speed' is NaN")

    def test_without_copies_the_arrays_are_the_shared_memory(self):
        envs = self.vector(2, copy=False)
        first, _ = envs.reset(seed=1)
        second = envs.step([[0.5, 0]] * 2)[0]
        self.assertTrue(numpy.shares_memory(first, second))
        copied = self.vector(2)
        first, _ = copied.reset(seed=1)
        self.assertFalse(numpy.shares_memory(first, copied.step([[0.5, 0]] * 2)[0]))

    def test_a_reset_without_a_seed_goes_on_from_the_one_before(self):
        def seeds():
            envs = self.vector(2)
            envs.reset(seed=3)
            return [list(envs.reset()[1]["seed"]) for _ in range(2)]
        one, other = seeds(), seeds()
        self.assertEqual(one, other)
        self.assertEqual(len({*one[0], *one[1], 3, 4}), 6)

    def test_a_saved_episode_is_a_journal_that_repeats_the_run(self):
        envs = self.vector(3, processes=2)
        envs.reset(seed=1)
        for _ in range(6):
            envs.step([[0.4, 0.2]] * 3)
        journal = os.path.join(self.folder, "second.journal")
        envs.save_episode(1, journal)
        x = envs.arrays["observations"][1, 4]
        envs.step([[0, 0]] * 3)
        said = subprocess.run([PROGRAM, "run", "--replay", journal, "--headless", "--record",
                               os.path.join(self.folder, "x.csv"), "--ports", "mouse.truth"], cwd=self.folder, text=True,
                              capture_output=True)
        self.assertEqual(said.returncode, 0, said.stderr)
        with open(os.path.join(self.folder, "x.csv")) as file:
            rows = [line.split(",") for line in file]
        self.assertEqual(len(rows), 1 + 1 + 6 * 5)  # the names, the first tick, and the steps
        # Recorded at the begin of the last tick.
        self.assertAlmostEqual(float(rows[-1][rows[0].index("mouse.truth.pose.position.x")]), x, delta=0.0041)
        self.assertIn("no such", self.refused(envs.save_episode, 1, os.path.join(self.folder, "no", "x")).lower())
        self.write("behaviors/systems/wall.lua", SYSTEM.replace("0.01", "0.02"))
        self.assertIn("the episode can't be repeated: files have changed since it began",
                      self.refused(envs.save_episode, 1, journal))

    def test_a_changed_file_is_used_from_the_next_episode_on(self):
        envs = self.vector(1)
        envs.reset(seed=1)
        self.write("behaviors/wall_env.lua", ENVIRONMENT.replace("steps + action[1]", "100 + steps"))
        envs.reload()
        self.assertEqual(envs.step([[0, 0]])[1][0], 1)
        envs.reset(seed=1)
        self.assertEqual(envs.step([[0, 0]])[1][0], 101)
        self.write("behaviors/wall_env.lua", ENVIRONMENT.replace("ticks = 5", "tick = 5"))
        self.assertEqual(self.refused(envs.reload),
                         "behaviors/wall_env.lua:5:3: environment: unknown field 'tick' (did you mean 'ticks'?)")
        envs.reset(seed=1)
        self.assertEqual(envs.step([[0, 0]])[1][0], 101)
        self.write("behaviors/wall_env.lua", ENVIRONMENT.replace('"x", ', ''))
        self.assertIn("actions and observations can't change while worlds use them", self.refused(envs.reload))

    def test_an_error_names_the_world_and_the_line_and_the_others_go_on(self):
        self.write("behaviors/wall_env.lua", ENVIRONMENT.replace("return steps + action[1]",
                                                                 "return action[1] > 0.2 and nothing.x or 1"))
        self.assertIn("behaviors/wall_env.lua:18:63: unknown global 'nothing'", self.refused(self.vector, 1))
        self.write("behaviors/wall_env.lua", ENVIRONMENT.replace("return steps + action[1]",
                                                                 "return action[1] > 0.2 and world.mous.x or 1"))
        envs = self.vector(3, processes=2)
        envs.reset(seed=1)
        self.assertEqual(self.refused(envs.step, [[0, 0], [0.3, 0], [0, 0]]),
                         "world 1: behaviors/wall_env.lua:18: reward: there is no component 'mous' (did you mean 'mouse'?)")
        self.assertEqual(list(envs.step([[0, 0]] * 3)[1]), [1, 0, 1])

    def test_worlds_and_options_that_are_not_there_are_refused(self):
        self.assertEqual(self.refused(self.vector, 0), "expected at least 1 world, got 0")
        envs = self.vector(2)
        self.assertEqual(self.refused(envs.reset, seed=1, options={"wall": 1}),
                         "there are no options: the environment's file says how an episode starts")
        for world in (-1, 2):
            self.assertEqual(self.refused(envs.save_episode, world, "x"), "there is no world %d: expected 0 to 1" % world)

    def test_a_process_that_ends_is_an_error(self):
        envs = self.vector(2, processes=2)
        envs.reset(seed=1)
        envs._processes[1].send_signal(signal.SIGKILL)
        envs._processes[1].wait()
        self.assertEqual(self.refused(envs.step, [[0, 0]] * 2), "a process with worlds has ended")
        envs.close()
        self.assertEqual(self.refused(envs.step, [[0, 0]] * 2), "the worlds are closed")

    def test_the_learner_gets_better(self):
        words = ["/usr/bin/python3", os.path.join(ROOT, "behaviors/environments/learn.py"),
                 os.path.join(ROOT, "behaviors/environments/stop_at_wall.lua"), "--rounds", "4", "--worlds", "24",
                 "--program", PROGRAM]
        environment = dict(os.environ, PYTHONPATH=os.path.join(ROOT, "bindings", "python"))
        lines = subprocess.run(words, env=environment, text=True, capture_output=True, check=True).stdout.splitlines()
        of_mean = [float(line.split("mean weights")[1].split(",")[0]) for line in lines if "mean weights " in line[:60]
                   and line.startswith("round")]
        self.assertEqual(len(of_mean), 4)
        self.assertGreater(of_mean[-1], of_mean[0])
        self.assertTrue(lines[-1].startswith("weights = { "))


if __name__ == "__main__":
    unittest.main(verbosity=2)
