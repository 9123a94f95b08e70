// A lift that learns your names for its floors, by the serial line: type a command, such as "up to the roof"; then "+" for good bot or "-"
// for bad bot after each move; then "!" when it has done as you meant. "?" asks how sure it is.
#include <goodbot.h>

enum { FLOORS = 4, UP = 0, DOWN = 1 };

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
static bool listens = true;

static bool fine(goodbot_status status) {
    if (status == GOODBOT_STATUS_OK) return true;
    Serial.println(goodbot_status_text(status));
    return false;
}

static void move_once() {
    goodbot_status status;
    uint8_t action;
    uint32_t floor;
    while ((status = goodbot_plan(robot, 10)) == GOODBOT_STATUS_WORKING) {
    }
    if (!fine(status) || !fine(goodbot_decide(robot, &action, nullptr)) || !fine(goodbot_acted(robot, action))) return;
    if (!fine(goodbot_table_state(robot, &floor))) return;
    Serial.print(action == UP ? "up, to floor " : action == DOWN ? "down, to floor " : "I stay on floor ");
    Serial.println(floor);
}

static void tell() {
    uint32_t task;
    float sure;
    char text[40];
    if (!fine(goodbot_most_likely(robot, &task)) || !fine(goodbot_task_text(robot, task, text, sizeof text))) return;
    if (!fine(goodbot_task_probability(robot, task, &sure))) return;
    Serial.print(text);
    Serial.print(", ");
    Serial.print(int(100 * sure));
    Serial.println(" %");
}

static void learn() {
    goodbot_status status;
    if (!fine(goodbot_finish(robot, nullptr))) return;
    while ((status = goodbot_learn(robot, 100)) == GOODBOT_STATUS_WORKING) {
    }
    if (fine(status)) Serial.println("learned");
    listens = true;
}

static void take(const char *text) {
    if (listens) {
        if (!fine(goodbot_hear(robot, text))) return;
        listens = false;
        tell();
        move_once();
    } else if (text[0] == '+' || text[0] == '-') {
        uint32_t evidence;
        if (fine(goodbot_feedback(robot, text[0] == '+' ? GOODBOT_REWARD : GOODBOT_PUNISH, &evidence))) move_once();
    } else if (text[0] == '!') {
        learn();
    } else if (text[0] == '?') {
        tell();
    } else {
        Serial.println("say + or - to the last move, ! to end the lesson, ? to ask");
    }
}

void setup() {
    goodbot_capacities capacities;
    Serial.begin(115200);
    table.classes = classes, table.class_count = 2, table.attributes = attributes, table.attribute_count = 1;
    table.propositions = propositions, table.proposition_count = 1, table.objects = objects, table.object_count = 5;
    table.actions = actions, table.action_count = 2, table.tasks = tasks, table.task_count = 1;
    table.state_count = FLOORS, table.start = 0, table.next = steps, table.holds = at_floor;
    if (fine(goodbot_preset(GOODBOT_TINY, &capacities)) && fine(goodbot_init_table(memory, sizeof memory, &capacities, &table, &robot)))
        Serial.println("Tell the lift where to go.");
}

void loop() {
    while (Serial.available() > 0) {
        int letter = Serial.read();
        if (letter == '\r') continue;
        if (letter != '\n') {
            if (length + 1 < sizeof line) line[length++] = char(letter);
            continue;
        }
        line[length] = 0;
        if (length > 0) take(line);
        length = 0;
    }
}
