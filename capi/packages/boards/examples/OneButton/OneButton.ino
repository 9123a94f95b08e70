// A lift with one button, which says "good bot". Type a command by the serial line, such as "up to the roof". Press after each move that is
// right, also when it rests where it should; after a wrong one do nothing. After two rests in a row that were praised, it learns.
#include <goodbot.h>

enum { FLOORS = 4, UP = 0, DOWN = 1, PIN = 2 };
// How long a move waits for the button, in milliseconds.
static const unsigned long WAIT = 2000;

GOODBOT_ALIGNED static unsigned char memory[GOODBOT_TINY_TABLE_BYTES];
static goodbot *robot;

static const char *const classes[] = {"lift", "floor"};
static const goodbot_carrier carriers[] = {{1, "floorIs"}};
static const goodbot_attribute attributes[] = {{"use", carriers, 1}};
static const goodbot_proposition propositions[] = {{"liftAtFloor", {0, 1, 0}, 2}};
static const goodbot_object objects[] = {
    {0, "lift0", {nullptr}}, {1, "floor0", {"garage"}}, {1, "floor1", {"shop"}}, {1, "floor2", {"office"}}, {1, "floor3", {"roof"}},
};
static const goodbot_action actions[] = {{"up", 1}, {"down", 1}};
static const char *const tasks[] = {"liftAtFloor(?l, ?f)"};
// For each floor, where up and down lead.
static const uint16_t steps[FLOORS * 2] = {1, GOODBOT_CANNOT, 2, 0, 3, 1, GOODBOT_CANNOT, 2};

// Floor n is object n + 1.
static bool at_floor(void *, uint32_t state, uint8_t, const uint8_t *arguments) { return arguments[1] == state + 1; }

static goodbot_table table;
static char line[64];
static unsigned length;
static bool acts, pressed;
static uint8_t action;
static unsigned rests;
static unsigned long moved_at;

static bool fine(goodbot_status status) {
    if (status == GOODBOT_STATUS_OK) return true;
    Serial.println(goodbot_status_text(status));
    acts = false;
    return false;
}

static void move_once() {
    goodbot_status status;
    uint32_t floor;
    while ((status = goodbot_plan(robot, 10)) == GOODBOT_STATUS_WORKING) {
    }
    if (!fine(status) || !fine(goodbot_decide(robot, &action, nullptr)) || !fine(goodbot_acted(robot, action))) return;
    if (!fine(goodbot_table_state(robot, &floor))) return;
    Serial.print(action == UP ? "up, to floor " : action == DOWN ? "down, to floor " : "I stay on floor ");
    Serial.println(floor);
    moved_at = millis();
    pressed = false;
}

static void learn() {
    goodbot_status status;
    acts = false;
    if (!fine(goodbot_finish(robot, nullptr))) return;
    while ((status = goodbot_learn(robot, 100)) == GOODBOT_STATUS_WORKING) {
    }
    if (fine(status)) Serial.println("learned");
}

// The time for the last move is over. No word says something, too: it is told.
static void judge() {
    uint32_t evidence;
    if (!fine(goodbot_feedback(robot, pressed ? GOODBOT_REWARD : GOODBOT_NEUTRAL, &evidence))) return;
    rests = pressed && action == GOODBOT_NOOP ? rests + 1 : 0;
    if (rests == 2) learn();
    else move_once();
}

void setup() {
    goodbot_capacities capacities;
    Serial.begin(115200);
    pinMode(PIN, INPUT_PULLUP);
    table.classes = classes, table.class_count = 2, table.attributes = attributes, table.attribute_count = 1;
    table.propositions = propositions, table.proposition_count = 1, table.objects = objects, table.object_count = 5;
    table.actions = actions, table.action_count = 2, table.tasks = tasks, table.task_count = 1;
    table.state_count = FLOORS, table.start = 0, table.next = steps, table.holds = at_floor;
    // The button only praises: silence after a right move is rare, and after a wrong one it is what is said.
    if (fine(goodbot_preset(GOODBOT_TINY, &capacities)) && fine(goodbot_init_table(memory, sizeof memory, &capacities, &table, &robot))
        && fine(goodbot_trainer(robot, 0.05f, 0.7f, 0.1f)))
        Serial.println("Tell the lift where to go.");
}

void loop() {
    if (acts) {
        pressed = pressed || digitalRead(PIN) == LOW;
        if (millis() - moved_at >= WAIT) judge();
        return;
    }
    while (!acts && Serial.available() > 0) {
        int letter = Serial.read();
        if (letter == '\r') continue;
        if (letter != '\n') {
            if (length + 1 < sizeof line) line[length++] = char(letter);
            continue;
        }
        line[length] = 0;
        if (length > 0 && fine(goodbot_hear(robot, line))) {
            acts = true, rests = 0;
            move_once();
        }
        length = 0;
    }
}
