-- Modules of behaviours: how they are loaded, and where their errors point.

--- A module that can't be loaded gives an error with its place.
-- file: bad.lua
local x = 1
local y = = 2

-- file: slip.lua
local x = 1
return { f = function() xx = 2 end }

-- file: hook.lua
function on_execute() end

-- file: cycle1.lua
require 'cycle2'

-- file: cycle2.lua
require 'cycle1'

-- file: fails.lua
local t = nil
t.x = 1

require 'c'  -- error: require 'c': there is no module 'c'

require 'bad'  -- error: bad.lua:2: unexpected symbol near '='

require 'slip'  -- error: slip.lua:2:25: unknown global 'xx' (did you mean 'x'?)

require 'hook'  -- error: hook.lua:1:10: 'on_execute' can't be used in a module: callbacks belong in the component's own file

require 'fails'  -- error: fails.lua:2: attempt to index a nil value (local 't') (called from behavior.lua:1)

require(3)  -- error: require expected a module's name, got number

require 'cycle1'
-- error: cycle2.lua:1: require 'cycle1': the modules require each other: cycle1 requires cycle2 requires cycle1 (called from behavior.lua:1)

--- An error of require can be caught with pcall and in a coroutine.
-- file: bad.lua
local x = 1
local y = = 2

-- file: cycle1.lua
require 'cycle2'

-- file: cycle2.lua
require 'cycle1'

-- file: fails.lua
local t = nil
t.x = 1

pcall(require, 'fails') pcall(require, 'fails') param('x', 1)

pcall(require, 'fails') function on_execute() end

pcall(require, 'bad') function on_execute() end

pcall(require, 'c') function on_execute() end

pcall(require, 'cycle1') function on_execute() end

coroutine.resume(coroutine.create(require), 'fails') function on_execute() end

coroutine.resume(coroutine.create(require), 'bad') function on_execute() end

coroutine.resume(coroutine.create(require), 'c') function on_execute() end

coroutine.resume(coroutine.create(require), 'cycle1') function on_execute() end

--- A module is loaded while the behaviour loads, not later.
-- file: a.lua
return 1

function on_execute() require 'a' end  -- error: require 'a': modules are loaded while the file loads; call require at the top of the file

--- An error in a module also gives the line of the behaviour that called it.
-- file: inner.lua
return { index = function(t)
  return t.x.y end }

-- file: outer.lua
local inner = require 'inner'
local M = {}
function M.index(t)
  local y = inner.index(t)
  return y end
function M.refuse(t)
  error('expected a table', 2) end
function M.call(f)
  f() end
function M.deep(n)
  if n == 0 then error('the end') end M.deep(n - 1) return 1 end
function M.raise(value)
  error(value) end
return M

local outer = require 'outer'
function on_execute()
  outer.index({})
end  -- error: inner.lua:2: attempt to index a nil value (field 'x') (called from behavior.lua:3)

local outer = require 'outer'
function on_execute()
  local function f()
    outer.index({}) end
  f()
end  -- error: inner.lua:2: attempt to index a nil value (field 'x') (called from behavior.lua:4)

-- The mistake is in this file: only its line is given.
local outer = require 'outer'
function on_execute()
  outer.refuse(1)  -- error: expected a table
end

local outer = require 'outer'
function on_execute()
  outer.call(function()
    error('mine') end)  -- error: mine
end

local outer = require 'outer'
function on_execute()
  outer.deep(5000)
end  -- error: outer.lua:11: the end (called from behavior.lua:3)

local outer = require 'outer'
function on_execute()
  outer.raise(nil)
end  -- error: outer.lua:13: an error of value nil

-- A coroutine has its own stack, without the line that resumed it.
local outer = require 'outer'
function on_execute()
  local co = coroutine.wrap(function()
    outer.index({}) end)
  co()  -- error: inner.lua:2: attempt to index a nil value (field 'x')
end

--- An error in a module that a task calls also gives the line of the task.
-- file: helper.lua
return { fail = function() error('no luck') end }

local helper = require 'helper'
task('t', function()
  helper.fail()
end)  -- error: helper.lua:1: no luck (called from behavior.lua:3)
