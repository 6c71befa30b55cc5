--- The module for frames: poses, and what it says of arguments that are wrong.

local poses = require "nezumi.poses"

--- What a call says when it fails, with its line, which is to be one of this file.
local function said(f)
  local ok, message = pcall(f)
  local file, text = tostring(message):match("^(.-):%d+: (.*)$")
  return not ok and file and file:match("poses_module_test%.lua$") and text or "not refused here: " .. tostring(message)
end

local function equal(s, actual, expected) s:check(actual == expected, ("%s, not %s"):format(actual, expected)) end

local function near_pose(s, actual, x, y, heading)
  s:near(actual.position.x, x, 1e-12)
  s:near(actual.position.y, y, 1e-12)
  s:near(actual.heading, heading, 1e-12)
end

scenario("poses in the plane are composed, inverted and related", function(s)
  local robot = poses.plane(1, 2, math.pi / 2)
  near_pose(s, poses.compose(robot, poses.plane(3, 1, math.pi)), 0, 5, -math.pi / 2)
  near_pose(s, poses.compose(robot, poses.inverse(robot)), 0, 0, 0)
  near_pose(s, poses.relative(robot, poses.plane(1, 4, math.pi)), 2, 0, math.pi / 2)
  local aside = poses.transform(poses.plane(1, 2, math.atan(3, 4)), { x = 5, y = 10 })
  s:near(aside.x, -1, 1e-12)
  s:near(aside.y, 13, 1e-12)
  local point = poses.transform(robot, { x = 1, y = 0 })
  s:near(point.x, 1, 1e-12)
  s:near(point.y, 3, 1e-12)
  local back = poses.to_local(robot, point)
  s:near(back.x, 1, 1e-12)
  s:near(back.y, 0, 1e-12)
end)

--- Angles that are not special, and those where x points straight up and down.
local in_space = {
  poses.space(1, -2, 0.5, 0.3, -0.4, 2.9),
  poses.space(0, 1, 2, -1.2, 1.1, -0.7),
  poses.space(3, 0, 0, 0.4, math.pi / 2, 1),
  poses.space(0, 0, -1, -0.3, -math.pi / 2, 0.2),
}

scenario("poses in space turn by yaw, then pitch, then roll", function(s)
  local point = poses.transform(poses.space(0, 0, 1, 0, 0, math.pi / 2), { x = 1, y = 0, z = 0 })
  s:near(point.x, 0, 1e-12)
  s:near(point.y, 1, 1e-12)
  s:near(point.z, 1, 1e-12)
  s:near(poses.transform(poses.space(0, 0, 0, 0, math.pi / 2, 0), { x = 1, y = 0, z = 0 }).z, -1, 1e-12, "nose down")
  s:near(poses.transform(poses.space(0, 0, 0, math.pi / 2, 0, 0), { x = 0, y = 1, z = 0 }).z, 1, 1e-12, "left side up")
end)

scenario("a pose composed in space moves points as its parts do, one after the other", function(s)
  local point = { x = 0.3, y = -0.2, z = 0.7 }
  for _, a in ipairs(in_space) do
    for _, b in ipairs(in_space) do
      local at_once, in_turn = poses.transform(poses.compose(a, b), point), poses.transform(a, poses.transform(b, point))
      local there_and_back = poses.transform(poses.relative(a, b), point)
      local other_way = poses.to_local(a, poses.transform(b, point))
      for _, axis in ipairs { "x", "y", "z" } do
        s:near(at_once[axis], in_turn[axis], 1e-9)
        s:near(there_and_back[axis], other_way[axis], 1e-9)
      end
    end
    local nothing = poses.compose(a, poses.inverse(a))
    s:near(nothing.position.x, 0, 1e-9)
    s:near(nothing.orientation.p, 0, 1e-9)
  end
end)

scenario("a pose that looks straight up or down has a yaw and no roll", function(s)
  local point = { x = 0.3, y = -0.2, z = 0.7 }
  for _, pitch in ipairs { math.pi / 2, -math.pi / 2 } do
    for _, roll in ipairs { 0, 0.4, -2 } do
      local a, b = poses.space(0, 0, 0, 0, 0, 0.7), poses.space(0, 0, 0, roll, pitch, 1.1)
      local both = poses.compose(a, b)
      s:equal(both.orientation.r, 0)
      s:near(both.orientation.p, pitch, 1e-7)
      local at_once, in_turn = poses.transform(both, point), poses.transform(a, poses.transform(b, point))
      for _, axis in ipairs { "x", "y", "z" } do s:near(at_once[axis], in_turn[axis], 1e-7) end
    end
  end
  -- Where rounding makes a sine greater than 1.
  for i = 0, 200 do
    local part = i * math.pi / 400
    for _, sign in ipairs { 1, -1 } do
      local both = poses.compose(poses.space(0, 0, 0, 0, sign * part, 0), poses.space(0, 0, 0, 0, sign * (math.pi / 2 - part), 0))
      s:near(both.orientation.p, sign * math.pi / 2, 1e-7)
    end
  end
end)

scenario("a value that is not a pose is refused", function(s)
  local a_pose = " expected a pose: { position = { x, y }, heading }, or position with z and orientation = { r, p, y }"
  equal(s, said(function() poses.inverse { x = 1, y = 2, heading = 0 } end), "poses.inverse" .. a_pose)
  equal(s, said(function() poses.transform(nil, {}) end), "poses.transform" .. a_pose)
  equal(s, said(function() poses.transform(poses.plane(0, 0, 0), { 1, 2 }) end), "poses.transform expected a point: { x, y }")
  equal(s, said(function() poses.to_local(in_space[1], { x = 1, y = 2 }) end), "poses.to_local expected a point: { x, y, z }")
  for _, name in ipairs { "compose", "relative" } do
    equal(s, said(function() poses[name](poses.plane(0, 0, 0), in_space[1]) end),
      ("poses.%s expected two poses in the plane or two in space, got one of each"):format(name))
    equal(s, said(function() poses[name](in_space[1], 1) end), "poses." .. name .. a_pose)
  end
  for make, names in pairs { plane = { "x", "y", "heading" }, space = { "x", "y", "z", "roll", "pitch", "yaw" } } do
    for i, name in ipairs(names) do
      local values = { 1, 2, 3, 4, 5, 6 }
      values[i] = {}
      equal(s, said(function() poses[make](table.unpack(values)) end),
        ("poses.%s: %s expected a finite number, got table"):format(make, name))
    end
  end
end)
