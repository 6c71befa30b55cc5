"""A solver for the simulator mms: finds the middle by flood fill, and shows what it knows. Nothing in it is of nezumi."""

import sys


def ask(*words):
    print(*words, flush=True)
    return sys.stdin.readline().strip()


def tell(*words):
    print(*words, flush=True)


WIDTH, HEIGHT = int(ask("mazeWidth")), int(ask("mazeHeight"))
STEPS = [(0, 1), (1, 0), (0, -1), (-1, 0)]
walls = set()
x = y = look = 0


def flood(goals):
    far = {cell: 0 for cell in goals}
    queue = list(goals)
    for cell in queue:
        for side, (right, up) in enumerate(STEPS):
            other = (cell[0] + right, cell[1] + up)
            inside = 0 <= other[0] < WIDTH and 0 <= other[1] < HEIGHT
            if inside and other not in far and (cell, side) not in walls:
                far[other] = far[cell] + 1
                queue.append(other)
    return far


def go(goals):
    global x, y, look
    while (x, y) not in goals:
        for turn, name in enumerate(("wallFront", "wallRight", None, "wallLeft")):
            if name and ask(name) == "true":
                side = (look + turn) % 4
                walls.add(((x, y), side))
                walls.add(((x + STEPS[side][0], y + STEPS[side][1]), (side + 2) % 4))
                tell("setWall", x, y, "nesw"[side])
        far = flood(goals)
        tell("setText", x, y, far[x, y])
        best = min((far.get((x + STEPS[s][0], y + STEPS[s][1]), 9999), (s - look) % 4, s)
                   for s in range(4) if ((x, y), s) not in walls)[2]
        for _ in range((best - look) % 4 if (best - look) % 4 != 3 else 0):
            ask("turnRight")
        if (best - look) % 4 == 3:
            ask("turnLeft")
        look = best
        if ask("moveForward") != "ack":
            sys.exit("crash at %d %d" % (x, y))
        x, y = x + STEPS[look][0], y + STEPS[look][1]


middle = {(i, j) for i in ((WIDTH - 1) // 2, WIDTH // 2) for j in ((HEIGHT - 1) // 2, HEIGHT // 2)}
go(middle)
tell("setColor", x, y, "G")
if "reset" in sys.argv:
    ask("ackReset")
    x = y = look = 0
    go(middle)
print("score", ask("getStat", "score"), file=sys.stderr)
