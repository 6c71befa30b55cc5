--- SpeechSample by itself, then the system in which the EV3 speaks.

scenario("forwards each text once", function(s)
  s:behavior("speech", { script = "speech_sample" })
  s:run(0.5)
  s:check(s.speech.out.age == math.huge, "silent until somebody speaks")
  s.speech:say "hello"
  s:run(0.02)
  s:check(s.speech.out.value == "hello")
  s:run(0.5)
  s:check(s.speech.out.age > 0.45, "said once")
end)

scenario("a text arrives unchanged, with any characters", function(s)
  local world = s:load "systems/speech.lua"
  local odd = { [[it's "quoted"]], "$(reboot); `reboot` | & > /tmp/x", "two\nlines\r\n", "-w /etc/passwd", "日本語", "a\0b" }
  for _, text in ipairs(odd) do
    world.speech:say(text)
    s:run(0.02)
  end
  s:near(#world.ev3.said, #odd, 0)
  for i, text in ipairs(odd) do s:check(world.ev3.said[i] == text, "text " .. i) end
  s:check(world.speech.status == "ACTIVE" and world.ev3.status == "ACTIVE")
end)

scenario("several texts of one moment are all spoken, in order", function(s)
  local world = s:load "systems/speech.lua"
  world.speech:say "one"
  world.speech:say "beep"
  world.speech:say "tone,880,100"
  s:run(0.05)
  s:check(table.concat(world.ev3.said, "|") == "one|beep|tone,880,100")
end)

scenario("a value that is not a text fails its command and nothing else", function(s)
  local world = s:load "systems/speech.lua"
  for _, wrong in ipairs { 5, true, {} } do
    local ok = pcall(function() world.speech:say(wrong) end)
    s:check(not ok, "refused")
  end
  s:run(0.1)
  s:check(world.speech.status == "ACTIVE")
  s:near(#world.ev3.said, 0, 0)
  world.speech:say "still here"
  s:run(0.05)
  s:check(world.ev3.said[1] == "still here")
end)
