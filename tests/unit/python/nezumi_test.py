"""The client in Python, and the environments on top of it, against real runs: nezumi_test.py NEZUMI."""

import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path.insert(0, os.path.join(ROOT, "bindings", "python"))

import nezumi  # noqa: E402
import nezumi_env  # noqa: E402

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "nezumi"
STOP_AT_WALL = "behaviors/systems/stop_at_wall.lua"
PATIENCE = 60.0  # [s]: machines may be slow, and busy


def start(file=STOP_AT_WALL, *options, **words):
    return nezumi.start(file, *options, program=PROGRAM, timeout=PATIENCE, folder=ROOT, **words)


class Case(unittest.TestCase):
    """Each has a folder of sockets of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        before = os.environ.get("XDG_RUNTIME_DIR")
        os.environ["XDG_RUNTIME_DIR"] = self.folder
        self.addCleanup(lambda: os.environ.__setitem__("XDG_RUNTIME_DIR", before) if before else
                        os.environ.pop("XDG_RUNTIME_DIR"))

    def refused(self, kind, action, *arguments, **words):
        with self.assertRaises(kind) as raised:
            action(*arguments, **words)
        return str(raised.exception)


class ConsoleTest(Case):
    def test_values_come_as_python_knows_them(self):
        with start() as console:
            self.assertEqual(console.eval("1 + 1"), 2)
            self.assertIsNone(console.eval("nil"))
            self.assertIs(console.eval("mouse.collided"), False)
            self.assertEqual(console.eval("{ 1, 2.5, 'x' }"), [1, 2.5, "x"])
            self.assertEqual(console.eval("1, 'two'"), [1, "two"])
            self.assertEqual(console.eval("mouse.truth.pose.position"), {"x": 0.0, "y": 0.0})
            self.assertEqual(console.eval("math.huge"), float("inf"))
            self.assertEqual(console.eval("1 / 3"), 1 / 3)
            self.assertEqual(console.eval(r"'a\n\"b\"\\ \195\188'"), 'a\n"b"\\ ü')
            self.assertEqual(console.eval(r"'\255\1'"), "\xff\x01")
            self.assertEqual(console.eval("('ü'):rep(5000)"), "ü" * 5000)
            deep = "local t = {} t.t = t return t"
            self.assertIn("a value within itself", self.refused(nezumi.Refused, console.eval, "(function() %s end)()" % deep))
            self.assertIn("a function has no form in Python", self.refused(nezumi.Refused, console.eval, "print"))

    def test_values_go_as_lua_writes_them(self):
        for value in (None, True, 3, -0.1, 1e300, "x\"\\\n\0ü", [1, [2.5, "a"]], {"vx": 0.1, "in": [True]}):
            with self.subTest(value=value):
                self.assertTrue(nezumi.lua(value))
        self.assertEqual(nezumi.lua((1, 2)), "{1,2}")
        self.assertEqual(nezumi.lua(b"\xff"), '"\\255"')
        self.assertEqual(nezumi.lua("\udcff"), '"\\255"')
        self.assertEqual(nezumi.lua("\ud800"), '"?"')
        self.assertEqual(nezumi.lua(float("-inf")), "-math.huge")
        self.assertEqual(self.refused(TypeError, nezumi.lua, object()), "a object has no form in Lua")
        with start() as console:
            for value in (True, 3, -0.1, 1e300, "x\"\\\nü", [1, [2.5, "a"]], {"vx": 0.1, "in": [True]}):
                self.assertEqual(console.eval(nezumi.lua(value)), value)

    def test_time_moves_by_exact_ticks_and_only_when_told(self):
        with start() as console:
            self.assertEqual(console.eval("now()"), 0)
            time.sleep(0.05)
            console.step(7)
            console.step()
            self.assertEqual(console.eval("now()"), 0.08)
            console.advance(0.12)
            self.assertEqual(console.eval("now()"), 0.2)

    def test_ports_are_looked_at_fed_and_held(self):
        with start() as console:
            console.set("controller", speed_x=0.2, stop_d=40)
            self.assertEqual(console.eval("controller.config.stop_d"), 40)
            console.advance(1)
            seen = console.look("controller.in")
            self.assertEqual(seen["type"], "TimedShortSeq")
            self.assertEqual(seen["peers"], ["mouse.ir_sensor_out"])
            self.assertEqual(len(seen["value"]), 4)
            console.hold("controller.in", [100, 0, 0, 0])
            console.step(2)
            self.assertEqual(console.look("controller.in")["override"], "held")
            self.assertEqual(console.look("controller.out")["value"]["vx"], 0)
            console.release("controller.in")
            self.assertEqual(console.look("controller.in")["override"], "")
            console.inject("mouse.pose_update", {"position": {"x": 1.0, "y": 2.0}, "heading": 0})
            console.step(2)
            self.assertGreater(console.look("mouse.current_pose_out")["value"]["position"]["x"], 0.9)

    def test_what_is_wrong_is_told_in_the_consoles_words(self):
        with start() as console:
            self.assertEqual(self.refused(nezumi.Refused, console.eval, "mouse.truht"),
                             "mouse has no 'truht' (did you mean 'truth'?)")
            self.assertIn("did you mean 'speed_x'?", self.refused(nezumi.Refused, console.set, "controller", speed_y=1))
            self.assertIn("above its maximum", self.refused(nezumi.Refused, console.set, "controller", speed_x=9))
            self.assertIn("mouse has no port 'nose'", self.refused(nezumi.Refused, console.hold, "mouse.nose", 1))
            self.assertIn("unexpected symbol", self.refused(nezumi.Refused, console.eval, "1 +"))
            self.assertEqual(console.run("print(1) print('a\\nb')"), "1\na\nb")
            self.assertEqual(console.eval("2"), 2)  # and it goes on

    def test_what_takes_too_long_is_interrupted_and_the_console_goes_on(self):
        with start() as console:
            said = self.refused(nezumi.Timeout, console.run, "while true do end", timeout=0.2)
            self.assertEqual(said, "no answer within 0.2 s")
            self.assertEqual(console.eval("1"), 1)

    def test_many_consoles_see_one_system(self):
        with start() as console:
            others = [nezumi.attach("stop_at_wall", timeout=PATIENCE) for _ in range(8)]
            results = [None] * len(others)

            def ask(i):
                others[i].run("mine = %d" % i)
                results[i] = [others[i].eval("mine * 100 + %d" % k) for k in range(50)]

            threads = [threading.Thread(target=ask, args=(i,)) for i in range(len(others))]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(results, [[i * 100 + k for k in range(50)] for i in range(8)])
            others[0].set("controller", speed_x=0.25)
            self.assertEqual(others[1].eval("controller.config.speed_x"), 0.25)
            self.assertEqual(self.refused(nezumi.Refused, console.eval, "mine"), "unknown name 'mine'")
            for other in others:
                other.close()
            self.assertEqual(console.eval("1"), 1)

    def test_the_end_of_a_run_is_told(self):
        console = start()
        other = nezumi.attach(timeout=PATIENCE)
        self.addCleanup(other.close)
        console.close()
        self.assertIn("ended", self.refused(nezumi.Ended, other.eval, "1"))
        self.assertEqual(self.refused(nezumi.Ended, nezumi.attach),
                         "nothing is running: start a system with `nezumi run FILE`")
        with start() as console:
            other = nezumi.attach(timeout=PATIENCE)
            self.addCleanup(other.close)
            other.run("quit()")
            self.refused(nezumi.Ended, console.eval, "1")

    def test_a_system_is_found_by_name_or_process(self):
        with start() as first, start() as second:
            running = nezumi.systems()
            self.assertEqual([each.name for each in running], ["stop_at_wall"] * 2)
            said = self.refused(nezumi.Error, nezumi.attach, "stop_at_wall")
            self.assertIn("several systems are running, choose one by its name or process number: stop_at_wall (process ", said)
            self.assertIn("no system 'room' is running; running: stop_at_wall", self.refused(nezumi.Ended, nezumi.attach, "room"))
            first.step(3)
            seen = []
            for each in running:
                with nezumi.attach(each.process, timeout=PATIENCE) as other:
                    seen.append(other.eval("now()"))
            self.assertEqual(sorted(seen), [0, 0.03])
            self.assertEqual(second.eval("now()"), 0)

    def test_a_paced_run_goes_on_while_it_is_looked_at(self):
        process = subprocess.Popen([PROGRAM, "run", STOP_AT_WALL, "--headless"], cwd=ROOT, stderr=subprocess.DEVNULL)
        try:
            end = time.monotonic() + PATIENCE
            while not nezumi.systems() and time.monotonic() < end:
                time.sleep(0.01)
            with nezumi.attach(timeout=PATIENCE) as console:
                begun = console.eval("now()")
                while console.eval("now()") <= begun and time.monotonic() < end:
                    pass
                self.assertGreater(console.eval("now()"), begun)
            self.assertIsNone(process.poll())
        finally:
            process.terminate()
            process.wait()

    def test_a_file_that_can_not_be_run_says_why(self):
        self.assertIn("none.lua: there is no such file", self.refused(nezumi.Ended, start, "none.lua"))
        said = self.refused(nezumi.Ended, nezumi.start, STOP_AT_WALL, program="/no/nezumi")
        self.assertEqual(said, "/no/nezumi can't be started: No such file or directory")

    def test_a_folder_that_others_can_enter_is_not_trusted(self):
        with start():
            os.chmod(os.path.join(self.folder, "nezumi"), 0o755)
            said = self.refused(nezumi.Error, nezumi.attach)
            self.assertIn("is open to others", said)
            os.chmod(os.path.join(self.folder, "nezumi"), 0o700)


DRIVE = {
    "act": 'hold("mouse.target_velocity_in", { vx = action[1], va = action[2] })',
    "observation": "mouse.ir_sensor_out.value",
    "reward": "mouse.truth.velocity.vx",
    "terminated": "mouse.collided",
    "ticks": 10,
}


def environment(**words):
    return nezumi_env.Environment(STOP_AT_WALL, program=PROGRAM, timeout=PATIENCE, folder=ROOT, **{**DRIVE, **words})


def episode(env, seed, steps=12):
    seen = [env.reset(seed=seed)]
    for k in range(steps):
        seen.append(env.step([0.4, 0.3 * (k % 3)]))
        if seen[-1][2] or seen[-1][3]:
            break
    return seen


class EnvironmentTest(Case):
    def test_an_episode_has_gymnasiums_shape(self):
        with environment() as env:
            observation, info = env.reset(seed=3)
            self.assertEqual((len(observation), info), (4, {"seed": 3}))
            observation, reward, terminated, truncated, info = env.step([0.3, 0.0])
            self.assertEqual(len(observation), 4)
            self.assertGreater(reward, 0)
            self.assertEqual((terminated, truncated, info), (False, False, {}))
            self.assertIs(env.unwrapped, env)

    def test_a_step_is_so_many_ticks(self):
        with environment(ticks=7, observation="now()") as env:
            first, _ = env.reset()
            self.assertEqual([round(env.step([0, 0])[0] - first, 9) for _ in range(3)], [0.07, 0.14, 0.21])

    def test_the_same_seed_gives_the_same_episode(self):
        noise = {"prepare": "drawn = random(0, 1) mouse:teleport { x = 0.1 * drawn, y = 0, heading = 0 }",
                 "observation": "{ drawn, mouse.truth.pose.position.x, mouse.truth.pose.heading }"}
        with environment(**noise) as env, environment(**noise) as another:
            once = episode(env, 1)
            self.assertEqual(episode(env, 1), once)
            self.assertEqual(episode(another, 1), once)
            self.assertNotEqual(episode(env, 2)[0], once[0])
            env.reset(seed=5)
            following = [env.reset() for _ in range(2)]
            another.reset(seed=5)
            self.assertEqual([another.reset() for _ in range(2)], following)
            self.assertNotEqual(following[0], following[1])

    def test_an_episode_ends_by_what_happens_or_by_its_limit(self):
        with environment(terminated="mouse.truth.pose.position.x > 0.1", limit=50) as env:
            seen = episode(env, 1, 60)
            self.assertTrue(seen[-1][2])
            self.assertFalse(seen[-1][3])
            self.assertEqual(self.refused(nezumi.Error, env.step, [0, 0]), "the episode is over: call reset()")
        with environment(limit=3) as env:
            self.assertEqual([step[3] for step in episode(env, 1)[1:]], [False, False, True])
        with environment() as env:
            self.refused(nezumi.Error, env.step, [0, 0])
            self.assertEqual(self.refused(nezumi.Error, lambda: env.console), "there is no world yet: call reset() first")

    def test_what_is_wrong_in_its_lua_is_told(self):
        with environment(observation="mouse.truht") as env:
            self.assertIn("mouse has no 'truht'", self.refused(nezumi.Refused, env.reset))
        with environment(act="hold('mouse.nose', action)") as env:
            env.reset()
            self.assertIn("nose", self.refused(nezumi.Refused, env.step, 1))

    def test_many_worlds_step_at_once_each_with_its_seed(self):
        words = {**DRIVE, "prepare": "mouse:teleport { x = random(0, 0.2), y = 0, heading = 0 }",
                 "observation": "mouse.truth.pose.position.x", "terminated": "mouse.truth.pose.position.x > 0.3"}
        with nezumi_env.Environments(3, STOP_AT_WALL, program=PROGRAM, timeout=PATIENCE, folder=ROOT, **words) as envs, \
                environment(**words) as alone:
            observations, info = envs.reset(seed=7)
            self.assertEqual(info, {"seed": [7, 8, 9]})
            self.assertEqual(observations, [alone.reset(seed=seed)[0] for seed in (7, 8, 9)])
            ended = [False] * 3
            for _ in range(20):
                observations, rewards, terminated, truncated, _ = envs.step([[0.4, 0.0]] * 3)
                for i in range(3):
                    if ended[i]:
                        self.assertEqual((rewards[i], terminated[i]), (0.0, False), "it has begun again")
                        self.assertLess(observations[i], 0.25)
                ended = terminated
            said = self.refused(nezumi.Error, envs.step, [[0, 0]])
            self.assertEqual(said, "expected 3 actions, one for each world, got 1")


if __name__ == "__main__":
    unittest.main()
