// Firmware of the rover: lines on USB set its speeds, and it answers with its encoders' counts.
//
//   v 0.100 -0.250   from the robot's computer: speed [m/s] and yaw rate [rad/s, counter-clockwise]
//   e 1203 1187      to the computer, 50 times a second: counts of the left and right encoder since the start
//   r 0.532          to the computer, 20 times a second: free distance ahead [m]
//   b 7.41           to the computer, once a second: the battery [V]
//
// Every other line is ignored, also an empty one. If no line "v" comes for 0.3 s, the motors stop: when the cable is
// pulled, or the computer loses its power, nothing else can stop the rover. Keep this time-out in your own firmware.
//
// For an Arduino Uno or Nano with a dual motor driver (two direction pins and a PWM pin for each motor) and quadrature
// encoders. Adapt the pins and the constants to your robot.

const int left_pwm = 5, left_ahead = 7, left_back = 8, right_pwm = 6, right_ahead = 9, right_back = 10;
const int left_a = 2, left_b = 4, right_a = 3, right_b = 11;
const int range_trigger = 12, range_echo = 13, battery = A0;

const float track = 0.150;              // m between the wheels
const float metres_per_count = 0.000144;  // 2 pi * 0.033 m / 1440
const float full_speed = 0.6;           // m/s at full PWM: the start of the controller
const float gain = 200;                 // PWM per m/s of error
const float volts_per_step = 5.0 / 1023 * 2;  // a divider by 2
const unsigned long time_out = 300;     // ms

volatile long left_count = 0, right_count = 0;
float wanted_left = 0, wanted_right = 0;  // m/s
unsigned long heard_at = 0;
char line[32];
byte length = 0;
bool is_too_long = false;

void count_left() { left_count = left_count + (digitalRead(left_b) == digitalRead(left_a) ? -1 : 1); }
void count_right() { right_count = right_count + (digitalRead(right_b) == digitalRead(right_a) ? 1 : -1); }

void set_motor(int pwm_pin, int ahead_pin, int back_pin, float wanted, float measured) {
  const float power = wanted == 0 ? 0 : wanted / full_speed * 255 + gain * (wanted - measured);
  digitalWrite(ahead_pin, power > 0 ? HIGH : LOW);
  digitalWrite(back_pin, power < 0 ? HIGH : LOW);
  analogWrite(pwm_pin, (int)constrain(fabs(power), 0.0, 255.0));
}

// Takes a line, which must be exactly "v SPEED RATE".
void take_line() {
  if (line[0] != 'v' || line[1] != ' ') return;
  char *end = line + 2;
  const double speed = strtod(line + 2, &end);
  if (end == line + 2 || *end != ' ') return;
  char *last = end + 1;
  const double rate = strtod(end + 1, &last);
  if (last == end + 1 || *last != '\0') return;
  wanted_left = speed - rate * track / 2;
  wanted_right = speed + rate * track / 2;
  heard_at = millis();
}

void read_lines() {
  while (Serial.available() > 0) {
    const char c = Serial.read();
    if (c == '\n') {
      line[length] = '\0';
      if (!is_too_long) take_line();
      length = 0;
      is_too_long = false;
    } else if (length < sizeof line - 1) {
      line[length++] = c;
    } else {
      is_too_long = true;
    }
  }
}

void tell_range() {
  digitalWrite(range_trigger, HIGH);
  delayMicroseconds(10);
  digitalWrite(range_trigger, LOW);
  const unsigned long echo = pulseIn(range_echo, HIGH, 12000);  // microseconds; 0: nothing within 2 m
  Serial.print("r ");
  Serial.println(echo == 0 ? 2.0 : echo * 0.0001715, 3);
}

void setup() {
  Serial.begin(115200);
  for (int pin : {left_pwm, left_ahead, left_back, right_pwm, right_ahead, right_back, range_trigger}) pinMode(pin, OUTPUT);
  for (int pin : {left_a, left_b, right_a, right_b}) pinMode(pin, INPUT_PULLUP);
  attachInterrupt(digitalPinToInterrupt(left_a), count_left, CHANGE);
  attachInterrupt(digitalPinToInterrupt(right_a), count_right, CHANGE);
}

void loop() {
  static unsigned long controlled_at = 0, range_at = 0, battery_at = 0;
  static long last_left = 0, last_right = 0;
  read_lines();
  const unsigned long now = millis();
  if (now - heard_at > time_out) wanted_left = wanted_right = 0;
  if (now - controlled_at >= 20) {
    const float seconds = (now - controlled_at) / 1000.0;
    controlled_at = now;
    noInterrupts();
    const long left = left_count, right = right_count;
    interrupts();
    set_motor(left_pwm, left_ahead, left_back, wanted_left, (left - last_left) * metres_per_count / seconds);
    set_motor(right_pwm, right_ahead, right_back, wanted_right, (right - last_right) * metres_per_count / seconds);
    last_left = left;
    last_right = right;
    Serial.print("e ");
    Serial.print(left);
    Serial.print(' ');
    Serial.println(right);
  }
  if (now - range_at >= 50) {
    range_at = now;
    tell_range();
  }
  if (now - battery_at >= 1000) {
    battery_at = now;
    Serial.print("b ");
    Serial.println(analogRead(battery) * volts_per_step, 2);
  }
}
