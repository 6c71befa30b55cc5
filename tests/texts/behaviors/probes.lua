-- Probes of behaviours: what is refused.

--- A probe takes a number, a boolean, a text or a flat table.
param('gains', { 1.0, 2.0 })
function on_execute() probe('p', 1) probe('p', config.gains) end

function on_execute() probe('p', print) end
-- error: probe 'p': expected a number, a boolean, a string or a flat table of them, got function

function on_execute() probe('p', nil) end
-- error: probe 'p': expected a number, a boolean, a string or a flat table of them, got nothing

function on_execute() probe('p', { { 1 } }) end
-- error: probe 'p': expected a number, a boolean, a string or a flat table of them, got a table that contains other values

function on_execute() probe('p', { [print] = 1 }) end
-- error: probe 'p': expected a number, a boolean, a string or a flat table of them, got a table that contains other values

function on_execute() local t = {} for i = 1, 64 do t[i] = i end probe('p', t) end

function on_execute() local t = {} for i = 1, 65 do t[i] = i end probe('p', t) end
-- error: probe 'p': a table can have at most 64 entries

function on_execute() probe('p', ('x'):rep(1000)) end

function on_execute() probe('p', ('x'):rep(1001)) end  -- error: probe 'p': its strings can have at most 1000 bytes in all

function on_execute() probe('p', { ('x'):rep(500), ('x'):rep(501) }) end  -- error: probe 'p': its strings can have at most 1000 bytes in all

--- The name of a probe must be an identifier, and probes are set while the behaviour runs.
function on_execute() probe('a b', 1) end
-- error: probe 'a b': the name is not an identifier: use letters, digits and _, no digit first, at most 100 of them

function on_execute() probe(1, 1) end  -- error: probe expected a name, got number

probe('p', 1) param('x', 1)  -- error: probe 'p': probe can't be called while the file loads

param('probe', 1)  -- error: parameter 'probe': the name is already used in every component: choose another, as 'my_probe'

--- A component has at most 64 probes.
function on_execute() for i = 1, 64 do probe('p' .. i, i) end probe('p1', 0) end

function on_execute() for i = 1, 65 do probe('p' .. i, i) end end  -- error: probe 'p65': a component can have at most 64 probes
