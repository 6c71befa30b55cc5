--- Sends on what a person types: `speech:say "hello"` at the prompt or in a scenario.

local out = output("out", "TimedString", "what is to be said")

command("say", function(text)
  out:write(text)
end, "speaks a text; beep and tone,HZ,MS are tones")
