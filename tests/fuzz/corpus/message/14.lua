return { ranges = { 1, 2 }, geometry = { pose = {}, size = { l = 1 }, elements = { {}, {} } }, config = { minAngle = 1 } }
