"""Takes the pictures of docs/browser.md from a real run. Usage: pictures.py NEZUMI [FOLDER]"""

import os
import shutil
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import editor_test
import rig
import rtcs_test

WALL = "behaviors/systems/stop_at_wall.lua"


def save(page, folder, name, selector=None):
    time.sleep(0.4)
    path = os.path.join(folder, "browser_%s.png" % name)
    with open(path, "wb") as file:
        file.write(page.find(selector).screenshot_as_png if selector else page.driver.get_screenshot_as_png())
    print("%s: %d KB" % (path, os.path.getsize(path) // 1024))


def take_rtcs(nezumi, page, folder):
    names, port, data = rtcs_test.start_names()
    started = [names] + [rtcs_test.start_rtc(nezumi, port, *words) for words in (
        ("Planner0", "velocity", "TimedVelocity2D", "out"), ("ConsoleIn0", "out", "TimedLong", "out"), ("ConsoleOut0", "in", "TimedLong", "in"))]
    system = rig.System(nezumi, text=rtcs_test.SYSTEM % (port, 'connect("rtm:Planner0.velocity", "mouse.target_velocity_in")\n'))
    try:
        started[2].say("link ConsoleIn0 out ConsoleOut0 in")
        started[1].say("activate Planner0")
        page.open(system.url)
        page.view("diagram")
        page.until("document.querySelectorAll('.wire-group').length === 2", "the connections are drawn")
        page.until("document.querySelector('.node.active.rtc') !== null", "the planner is active")
        page.js("document.querySelector('.node.active.rtc .title').focus()")
        page.until("document.querySelector('.rtc-card .slider') !== null", "its configuration is shown")
        save(page, folder, "rtcs", ".stage")
    finally:
        system.end()
        for each in started:
            each.kill()
        shutil.rmtree(data, ignore_errors=True)


def take_editor(nezumi, page, folder):
    system = rig.System(nezumi, text=editor_test.SYSTEM, scripts={"guide": editor_test.GUIDE, "lib/tools": "return { a = 1 }\n"})
    try:
        page.open(system.url)
        page.view("editor")
        page.press("Values")
        page.until("document.querySelectorAll('.line-values').length > 2", "values are shown")
        save(page, folder, "editor", ".stage")
    finally:
        system.end()


def take(nezumi, folder):
    page = rig.Page((1280, 800))
    wall = rig.System(nezumi, WALL)
    stick = rig.System(nezumi, "behaviors/systems/joystick.lua")
    try:
        page.open(wall.url)
        page.choose(".world select", "robot 0")
        page.view("plots")
        page.plot("controller.out", "vx")
        page.plot("mouse.current_velocity_out", "vx")
        page.view("world")
        page.view("parameters")
        rig.wait_until(lambda: page.pose()[0] > 0.4, "the mouse is before the wall")
        page.view("console")
        page.find(".console textarea").send_keys("mouse.ir_sensor_out\n")
        page.until("document.querySelectorAll('.console pre').length > 2", "the console has answered")
        page.js("document.activeElement.blur()")
        save(page, folder, "world")
        page.view("explain")
        page.until("document.querySelectorAll('.explain .step').length > 3", "it is explained")
        save(page, folder, "explain", ".side")
        rig.wait_until(lambda: page.js("return document.querySelector('.clock').textContent.split(' ')[0] > 9"), "it stands")
        page.view("plots")
        page.until("document.querySelectorAll('.plots canvas').length > 0", "it is drawn")
        save(page, folder, "plots", ".stage")
        page.view("parameters")
        field = page.find("input.number[aria-label='controller.speed_r']")
        field.clear()
        field.send_keys("0.5\n")
        page.until("document.querySelector('.parameter.changed')", "it is marked")
        page.js("document.activeElement.blur()")
        save(page, folder, "parameters", ".side .card")

        page.open(stick.url)
        page.view("diagram")
        page.drawn()
        page.keys().move_to_element(page.find(".port[data-port='mouse.ir_sensor_out'] .dot")).perform()
        save(page, folder, "system", ".stage")

        take_editor(nezumi, page, folder)
        take_rtcs(nezumi, page, folder)

        page.open(stick.url)
        page.resize(390, 800, dark=True)
        page.view("drive")
        pad = page.find(".pad")
        page.keys().move_to_element(pad).click_and_hold().move_by_offset(-18, -52).perform()
        time.sleep(2)
        save(page, folder, "drive")
        page.keys().release().perform()
    finally:
        wall.end()
        stick.end()
        page.close()


if __name__ == "__main__":
    take(os.path.abspath(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else os.path.join(rig.ROOT, "docs", "images"))
