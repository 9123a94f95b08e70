/* goodbot for C++17, in the namespace `good`: the functions of goodbot.h with types, and robots that cannot be copied. No exception is thrown,
   nothing is allocated. examples/lift.cpp is a whole program. */
#ifndef GOODBOT_HPP
#define GOODBOT_HPP

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "goodbot.h"

namespace good {

/** The result of a call: its status and its value. */
template <class T> class outcome {
public:
    outcome(goodbot_status status) : status_(status) {}
    outcome(T value) : status_(GOODBOT_STATUS_OK), value_(std::move(value)) {}

    goodbot_status status() const { return status_; }
    /** Whether the call succeeded: then there is a value. */
    explicit operator bool() const { return status_ == GOODBOT_STATUS_OK; }
    /** A text for people. */
    const char *text() const { return goodbot_status_text(status_); }

    T &operator*() { return assert(*this), value_; }
    const T &operator*() const { return assert(*this), value_; }
    T *operator->() { return assert(*this), &value_; }
    const T *operator->() const { return assert(*this), &value_; }

private:
    goodbot_status status_;
    T value_{};
};

/** The result of a call without a value. */
template <> class outcome<void> {
public:
    outcome(goodbot_status status = GOODBOT_STATUS_OK) : status_(status) {}

    goodbot_status status() const { return status_; }
    explicit operator bool() const { return status_ == GOODBOT_STATUS_OK; }
    /** There is more to do: call again. */
    bool is_working() const { return status_ == GOODBOT_STATUS_WORKING; }
    const char *text() const { return goodbot_status_text(status_); }

private:
    goodbot_status status_;
};

/** Elements one after the other, in the caller's memory. */
template <class T> class span {
public:
    constexpr span() = default;
    constexpr span(T *data, std::size_t size) : data_(data), size_(size) {}
    template <std::size_t N> constexpr span(T (&array)[N]) : data_(array), size_(N) {}

    constexpr T *data() const { return data_; }
    constexpr std::size_t size() const { return size_; }
    constexpr T *begin() const { return data_; }
    constexpr T *end() const { return data_ + size_; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/** Memory for a robot: `static good::memory<GOODBOT_SMALL_BYTES> memory;`. It must stay in place, so it can neither be copied nor moved. */
template <std::size_t Bytes> class memory {
public:
    memory() = default;
    memory(const memory &) = delete;
    memory &operator=(const memory &) = delete;

    span<unsigned char> bytes() { return bytes_; }

private:
    alignas(8) unsigned char bytes_[Bytes];
};

/** The robot's decision: an action, and the kind of plan (GOODBOT_PLAN_...). */
struct decision {
    std::uint8_t action = GOODBOT_NOOP;
    std::uint32_t plan = GOODBOT_PLAN_UNKNOWN;
};

/** A task that a command can mean, and its probability. */
struct meaning {
    std::uint32_t task = 0;
    float probability = 0;
};

/** A place of the robot or of a block. */
struct cell {
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/** What the trainer says to the last action. */
enum class word : std::int32_t { good = GOODBOT_REWARD, bad = GOODBOT_PUNISH, silence = GOODBOT_NEUTRAL };

/** A preset's capacities (GOODBOT_SMALL, GOODBOT_TINY, GOODBOT_OWN, GOODBOT_STANDARD), to be raised where a table is full. */
inline outcome<goodbot_capacities> preset(std::uint32_t preset) {
    goodbot_capacities capacities;
    goodbot_status status = goodbot_preset(preset, &capacities);
    return status == GOODBOT_STATUS_OK ? outcome<goodbot_capacities>(capacities) : status;
}

/**
 * A robot in the caller's memory. The functions are those of goodbot.h, which says what each does; `get` returns the handle for the others.
 * A robot that was moved from, or was never made, answers GOODBOT_STATUS_NULL.
 */
class robot {
public:
    robot() = default;
    robot(const robot &) = delete;
    robot &operator=(const robot &) = delete;
    robot(robot &&other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    robot &operator=(robot &&other) noexcept {
        handle_ = std::exchange(other.handle_, nullptr);
        return *this;
    }

    /** A robot in a home, which is described next. The memory outlives it. */
    static outcome<robot> in_home(span<unsigned char> memory, const goodbot_capacities &capacities) {
        robot made;
        return finish(goodbot_init_home(memory.data(), memory.size(), &capacities, &made.handle_), made);
    }

    /** A robot of the caller's own. The memory and the table outlive it. */
    static outcome<robot> of_table(span<unsigned char> memory, const goodbot_capacities &capacities, const goodbot_table &table) {
        robot made;
        return finish(goodbot_init_table(memory.data(), memory.size(), &capacities, &table, &made.handle_), made);
    }

    /** The handle of goodbot.h. */
    ::goodbot *get() const { return handle_; }

    outcome<void> seed(std::uint64_t seed) { return goodbot_seed(handle_, seed); }

    /* The home. */
    outcome<void> home_begin() { return goodbot_home_begin(handle_); }
    outcome<void> room(const char *name, std::int32_t left, std::int32_t bottom, std::int32_t right, std::int32_t top, const char *color) {
        return goodbot_home_room(handle_, name, left, bottom, right, top, color);
    }
    outcome<void> door(const char *name, std::int32_t left, std::int32_t bottom, std::int32_t right, std::int32_t top) {
        return goodbot_home_door(handle_, name, left, bottom, right, top);
    }
    outcome<void> block(const char *name, cell at, const char *color, const char *shape) {
        return goodbot_home_block(handle_, name, at.x, at.y, color, shape);
    }
    outcome<void> agent(const char *name, cell at) { return goodbot_home_agent(handle_, name, at.x, at.y); }
    outcome<void> home_build() { return goodbot_home_build(handle_); }
    outcome<void> place(const char *name, cell at) { return goodbot_home_place(handle_, name, at.x, at.y); }
    outcome<cell> where(const char *name) const {
        cell at;
        return finish(goodbot_home_where(handle_, name, &at.x, &at.y), at);
    }

    /* A robot of the caller's own. */
    outcome<void> set_state(std::uint32_t state) { return goodbot_table_set_state(handle_, state); }
    outcome<std::uint32_t> state() const {
        std::uint32_t state = 0;
        return finish(goodbot_table_state(handle_, &state), state);
    }

    /* A session. */
    outcome<void> hear(const char *command) { return goodbot_hear(handle_, command); }
    /** Plans with a budget: `while (robot.plan(50).is_working()) { ... }`. */
    outcome<void> plan(std::uint32_t budget) { return goodbot_plan(handle_, budget); }
    outcome<decision> decide() {
        decision decided;
        return finish(goodbot_decide(handle_, &decided.action, &decided.plan), decided);
    }
    outcome<void> acted(std::uint8_t action) { return goodbot_acted(handle_, action); }
    /** The name of the version before, for one release more. */
    outcome<void> done(std::uint8_t action) { return acted(action); }
    /** Returns how the word counts as evidence (GOODBOT_EVIDENCE_...). */
    outcome<std::uint32_t> feedback(word said) {
        std::uint32_t evidence = GOODBOT_EVIDENCE_UNINFORMATIVE;
        return finish(goodbot_feedback(handle_, static_cast<std::int32_t>(said), &evidence), evidence);
    }
    /** Returns how many older sessions were forgotten. */
    outcome<std::uint32_t> finish_session() {
        std::uint32_t gave_way = 0;
        return finish(goodbot_finish(handle_, &gave_way), gave_way);
    }
    outcome<void> learn(std::uint32_t budget) { return goodbot_learn(handle_, budget); }
    outcome<void> forget() { return goodbot_forget(handle_); }

    /* What it believes. */
    outcome<meaning> most_likely() const {
        meaning found;
        goodbot_status status = goodbot_most_likely(handle_, &found.task);
        if (status == GOODBOT_STATUS_OK) status = goodbot_task_probability(handle_, found.task, &found.probability);
        return finish(status, found);
    }
    outcome<void> task_text(std::uint32_t task, span<char> buffer) const {
        return goodbot_task_text(handle_, task, buffer.data(), buffer.size());
    }

    /* Its model. `save` returns the number of bytes written. */
    outcome<std::size_t> saved_size() const {
        std::size_t bytes = 0;
        return finish(goodbot_saved_size(handle_, &bytes), bytes);
    }
    outcome<std::size_t> save(span<std::uint8_t> buffer) const {
        std::size_t written = 0;
        return finish(goodbot_save(handle_, buffer.data(), buffer.size(), &written), written);
    }
    outcome<std::size_t> save_parameters(span<std::uint8_t> buffer) const {
        std::size_t written = 0;
        return finish(goodbot_save_parameters(handle_, buffer.data(), buffer.size(), &written), written);
    }
    outcome<void> restore_parameters(span<const std::uint8_t> parameters) {
        return goodbot_restore_parameters(handle_, parameters.data(), parameters.size());
    }
    outcome<void> restore(span<const std::uint8_t> model) { return goodbot_restore(handle_, model.data(), model.size()); }
    /* Returns the number of sentences; an empty model takes them away. */
    outcome<std::uint32_t> join_starter(span<const std::uint8_t> model) {
        std::uint32_t added = 0;
        return finish(goodbot_join_starter(handle_, model.size() ? model.data() : nullptr, model.size(), &added), added);
    }

private:
    template <class T> static outcome<T> finish(goodbot_status status, T &value) {
        if (status != GOODBOT_STATUS_OK) return status;
        return outcome<T>(std::move(value));
    }

    ::goodbot *handle_ = nullptr;
};

} // namespace good

#endif /* GOODBOT_HPP */
