"""What the world's picture shows, and what a hand does there, in a real browser. Usage: world_test.py NEZUMI [TEST...]"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig


class Shown(rig.PageCase):
    """The picture."""

    def test_the_picture_on_the_floor_is_drawn(self):
        self.open("behaviors/systems/line_follower.lua")
        self.page.until("document.querySelector('canvas').dataset.floor === 'shown'", "the floor's picture has come")
        self.assertEqual(self.page.errors(), [])

    def test_the_link_for_looking_lets_nobody_steer(self):
        system = self.open("behaviors/systems/stop_at_wall.lua")
        token = self.page.js("return new Promise((done) => { Object.defineProperty(navigator, 'clipboard',"
                             " { value: { writeText: async (text) => done(text) } });"
                             " document.querySelector('header .share').click(); })")
        self.assertNotIn(system.url.split("#")[1], token)
        other = rig.Page()
        self.addCleanup(other.close)
        other.open(token)
        other.until("document.body.classList.contains('view-only')", "it is told that it may look only")
        other.find("body").send_keys(" ")
        other.drawn()
        self.assertFalse(self.page.js("return document.body.classList.contains('stopped')"))


if __name__ == "__main__":
    sys.exit(rig.main("__main__"))
