--- The EV3 speaks: `speech:say "hello"` at the prompt.
robot    "ev3"    { model = "ev3", pose = { x = 0, y = 0, heading = 0 } }
behavior "speech" { script = "speech_sample" }

connect("speech.out", "ev3.sound")
