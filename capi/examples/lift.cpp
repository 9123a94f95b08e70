// The lift of lift.c in C++: four floors, and the names that people have for them.
#include <goodbot.hpp>

#include <cstdio>
#include <cstring>
#include <type_traits>

namespace {

enum : std::uint32_t { FLOORS = 4 };
enum : std::uint8_t { UP, DOWN };

good::memory<GOODBOT_TINY_TABLE_BYTES> memory;

const char *const classes[] = {"lift", "floor"};
const goodbot_carrier carriers[] = {{1, "floorIs"}};
const goodbot_attribute attributes[] = {{"use", carriers, 1}};
const goodbot_proposition propositions[] = {{"liftAtFloor", {0, 1, 0}, 2}};
const goodbot_object objects[] = {
    {0, "lift0", {nullptr}}, {1, "floor0", {"garage"}}, {1, "floor1", {"shop"}}, {1, "floor2", {"office"}}, {1, "floor3", {"roof"}},
};
const goodbot_action actions[] = {{"up", 1}, {"down", 1}};
const char *const tasks[] = {"liftAtFloor(?l, ?f)"};
// For each floor, where up and down lead.
const std::uint16_t steps[FLOORS * 2] = {1, GOODBOT_CANNOT, 2, 0, 3, 1, GOODBOT_CANNOT, 2};

// Floor n is object n + 1.
bool at_floor(void *, std::uint32_t state, std::uint8_t, const std::uint8_t *arguments) { return arguments[1] == state + 1; }

goodbot_table described() {
    goodbot_table table{};
    table.classes = classes, table.class_count = 2, table.attributes = attributes, table.attribute_count = 1;
    table.propositions = propositions, table.proposition_count = 1, table.objects = objects, table.object_count = 5;
    table.actions = actions, table.action_count = 2, table.tasks = tasks, table.task_count = 1;
    table.state_count = FLOORS, table.next = steps, table.holds = at_floor;
    return table;
}

template <class T> bool fine(const good::outcome<T> &outcome) {
    if (!outcome) std::printf("%s\n", outcome.text());
    return bool(outcome);
}

// Does work in parts to its end; false if it failed.
template <class F> bool to_its_end(F part) {
    good::outcome<void> outcome;
    do {
        outcome = part();
    } while (outcome.is_working());
    return fine(outcome);
}

bool lesson(good::robot &robot, const char *command, std::uint32_t from, std::uint32_t goal) {
    if (!fine(robot.set_state(from)) || !fine(robot.hear(command))) return false;
    for (int turns = 0, rests = 0; turns < 50 && rests < 3; turns++) {
        if (!to_its_end([&] { return robot.plan(10); })) return false;
        auto decided = robot.decide();
        auto floor = robot.state();
        if (!fine(decided) || !fine(floor) || !fine(robot.acted(decided->action))) return false;
        bool right = decided->action == (*floor < goal ? UP : *floor > goal ? DOWN : GOODBOT_NOOP);
        if (!fine(robot.feedback(right ? good::word::good : good::word::bad))) return false;
        rests = right && *floor == goal ? rests + 1 : 0;
    }
    return fine(robot.finish_session()) && to_its_end([&] { return robot.learn(100); });
}

} // namespace

int main() {
    static_assert(!std::is_copy_constructible_v<good::robot> && std::is_nothrow_move_constructible_v<good::robot>);
    static const goodbot_table table = described();
    auto capacities = good::preset(GOODBOT_TINY);
    if (!fine(capacities)) return 1;
    auto made = good::robot::of_table(memory.bytes(), *capacities, table);
    if (!fine(made)) return 1;
    good::robot robot = std::move(*made);
    // A robot that was moved from answers by a status.
    if (made->hear("up").status() != GOODBOT_STATUS_NULL) return 1;
    for (int round = 0; round < 2; round++) {
        if (!lesson(robot, "up to the roof", 0, 3) || !lesson(robot, "take me shopping", 3, 1)) return 1;
    }

    static std::uint8_t model[2048];
    auto saved = robot.save(model);
    if (!fine(saved) || !fine(robot.restore({model, *saved})) || !to_its_end([&] { return robot.learn(100); })) return 1;
    char text[40];
    if (!fine(robot.set_state(0)) || !fine(robot.hear("take me shopping"))) return 1;
    auto meant = robot.most_likely();
    if (!fine(meant) || !fine(robot.task_text(meant->task, text))) return 1;
    std::printf("\"take me shopping\": %s\n", text);
    return std::strcmp(text, "liftAtFloor(lift0,floor1)") != 0;
}
