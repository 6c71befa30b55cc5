--- Keeps all that comes to it, for scenarios that look at each message of a tick.

local texts = input("texts", "TimedString", "kept in state.texts", { queue = 100 })
local bytes = input("bytes", "TimedOctetSeq", "kept in state.bytes", { queue = 100 })

state.texts, state.bytes = state.texts or {}, state.bytes or {}

command("forget", function() state.texts, state.bytes = {}, {} end)

function on_execute()
  while texts.is_new do table.insert(state.texts, texts:read()) end
  while bytes.is_new do table.insert(state.bytes, bytes:read()) end
end
