//! A robot that breaks a rule of its `Domain` is told which one.

use goodbot::memory::HomeMemory;
use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, Checked, Class, ClassId, Domain, DomainFlaw, GroundProposition, Object, ObjectId, ObjectSet,
    ObjectTables, OneByOne, Proposition, PropositionId, Schema, World, check,
};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, HeapMemory, Options};
use goodbot_tests::turning_robot::TurningRobot;

/// A cart on a rail of four places, whose description and rules a test can break.
#[derive(Clone)]
struct Cart {
    schema: Schema<'static>,
    actions: Vec<ActionKind<'static>>,
    objects: Vec<(ClassId, &'static str, &'static [&'static str])>,
    states: u64,
    number: fn(u64) -> u64,
    /// The places where something blue is.
    blue: u64,
}

/// The cart's objects have memory of their own.
struct OnRail<'m> {
    cart: Cart,
    objects: goodbot::oomdp::Objects<'m>,
    asked: std::cell::Cell<u64>,
    wavers: bool,
}

const CART: ClassId = ClassId::new(0);
const PLACE: ClassId = ClassId::new(1);
const COLOR: Attribute<'static> = Attribute::new("color", &[Carrier::new(PLACE, "placeIs")]);
const AT: Proposition<'static> = Proposition::new("cartAtPlace", &[CART, PLACE]);
const SOUND: Schema<'static> = Schema { classes: &[Class::new("cart"), Class::new("place")], attributes: &[COLOR], propositions: &[AT] };
const NO_PLACES: Schema<'static> = Schema { classes: &[Class::new("cart")], ..SOUND };

impl Default for Cart {
    fn default() -> Self {
        Self {
            schema: SOUND,
            actions: vec![ActionKind::new("left", 1), ActionKind::new("right", 1)],
            objects: vec![(CART, "cart0", &[]), (PLACE, "place0", &["red"]), (PLACE, "place3", &["blue"])],
            states: 4,
            number: |state| state,
            blue: 3,
        }
    }
}

impl Domain for OnRail<'_> {
    type State = u64;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: self.cart.schema, objects: self.objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &self.cart.actions
    }

    fn step(&self, &place: &u64, action: Action) -> Option<u64> {
        self.asked.set(self.asked.get() + 1);
        let place = if self.wavers && self.asked.get().is_multiple_of(2) { 0 } else { place };
        if action == Action::new(0) { place.checked_sub(1) } else { Some(place + 1).filter(|&place| place < 4) }
    }

    fn holds(&self, proposition: &GroundProposition, &place: &u64) -> bool {
        place == if proposition.arguments[1] == ObjectId::new(1) { 0 } else { self.cart.blue }
    }

    fn state_count(&self) -> u64 {
        self.cart.states
    }

    fn number(&self, &place: &u64) -> u64 {
        (self.cart.number)(place)
    }

    fn numbered(&self, number: u64) -> u64 {
        number
    }
}

fn on_rail<T>(cart: Cart, wavers: bool, run: impl FnOnce(&OnRail<'_>) -> T) -> T {
    let (mut objects, mut name_bytes, mut name_ends) = ([Object::UNUSED; 4], [0; 64], [0; 8]);
    let mut set = ObjectSet::new(ObjectTables { objects: &mut objects, name_bytes: &mut name_bytes, name_ends: &mut name_ends });
    for (class, name, values) in &cart.objects {
        set.add(*class, name, values).unwrap();
    }
    run(&OnRail { cart, objects: set.into_objects(), asked: std::cell::Cell::new(0), wavers })
}

/// The result of `check` for a cart.
fn found(cart: Cart) -> Result<Checked, DomainFlaw> {
    on_rail(cart, false, |cart| check(cart, 0, 1_000))
}

/// The message of the flaw.
fn refusal(cart: Cart) -> String {
    found(cart).unwrap_err().to_string()
}

#[test]
fn a_sound_robot_is_tried_in_every_state() {
    let mut memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    let robot = TurningRobot::new(4, vec![5], vec![0, 15], memory.home.lend().objects);
    assert!(check(&robot, robot.start(1, 6), 100_000).unwrap().all);
}

#[test]
fn as_many_states_are_tried_as_are_asked_for() {
    assert_eq!(found(Cart::default()), Ok(Checked { states: 4, all: true, never_held: None }));
    let three = on_rail(Cart::default(), false, |cart| check(cart, 0, 3));
    assert_eq!(three, Ok(Checked { states: 3, all: false, never_held: None }));
}

#[test]
fn a_robot_is_never_asked_for_an_action_that_it_does_not_have() {
    on_rail(Cart::default(), false, |cart| {
        assert_eq!(goodbot::oomdp::apply(cart, &2, Action::new(1)), Some(3));
        assert_eq!((goodbot::oomdp::apply(cart, &2, Action::new(2)), cart.asked.get()), (None, 1));
    });
}

#[test]
fn two_states_of_one_number_are_found() {
    assert_eq!(
        refusal(Cart { number: |place| place / 2, ..Cart::default() }),
        DomainFlaw::Numbered { number: 0, from: Some((0, Action::new(1))) }.to_string()
    );
}

#[test]
fn a_number_beyond_the_state_count_is_found() {
    assert_eq!(
        found(Cart { states: 3, ..Cart::default() }),
        Err(DomainFlaw::Number { number: 3, count: 3, from: Some((2, Action::new(1))) })
    );
}

#[test]
fn a_step_that_wavers_is_found() {
    assert!(matches!(on_rail(Cart::default(), true, |cart| check(cart, 2, 1_000)), Err(DomainFlaw::Step { .. })));
}

#[test]
fn a_proposition_that_holds_nowhere_is_told() {
    // It holds in one place, so a task can ask for it.
    assert_eq!(found(Cart { blue: 4, ..Cart::default() }).unwrap().never_held, None);
    let nowhere =
        Cart { blue: 4, objects: vec![(CART, "cart0", &[]), (CART, "cart1", &[]), (PLACE, "place3", &["blue"])], ..Cart::default() };
    assert_eq!(found(nowhere).unwrap().never_held, Some(PropositionId::new(0)));
}

#[test]
fn actions_are_refused_by_number_and_cost_when_a_command_is_heard_too() {
    let given = Action::MOST + 1;
    let many = Cart { actions: vec![ActionKind::new("left", 1); given], ..Cart::default() };
    let free = Cart { actions: vec![ActionKind::new("left", 1), ActionKind::new("right", 0)], ..Cart::default() };
    for (cart, flaw) in [(many, DomainFlaw::Actions { given }), (free, DomainFlaw::Cost { action: Action::new(1), cost: 0 })] {
        assert_eq!(found(cart.clone()), Err(flaw));
        let tasks = [LiftedTask::parse("cartAtPlace(?c, ?p)", &SOUND).unwrap()];
        let mut agent = Agent::new(HeapMemory::new(&goodbot::Capacities::SMALL).agent, &tasks, Options::DEFAULT).unwrap();
        let heard = on_rail(cart, false, |cart| agent.hear(cart, &0, "go to red"));
        assert_eq!(heard, Err(AgentError::Domain(flaw)));
    }
}

#[test]
fn names_that_are_empty_or_stand_twice_are_found() {
    for name in ["", "left", "noop"] {
        let actions = vec![ActionKind::new("left", 1), ActionKind { name, cost: 1 }];
        assert_eq!(found(Cart { actions, ..Cart::default() }), Err(DomainFlaw::ActionName { action: Action::new(1) }));
    }
    let schema = Schema { classes: const { &[Class::new("cart"), Class::new("cart")] }, ..SOUND };
    assert_eq!(found(Cart { schema, ..Cart::default() }), Err(DomainFlaw::ClassName { class: PLACE }));
    let schema = Schema { propositions: &[AT, AT], ..SOUND };
    assert_eq!(found(Cart { schema, ..Cart::default() }), Err(DomainFlaw::PropositionName { proposition: PropositionId::new(1) }));
}

#[test]
fn a_schema_that_speaks_of_a_class_it_does_not_have_is_found() {
    assert_eq!(found(Cart { schema: NO_PLACES, ..Cart::default() }), Err(DomainFlaw::Parameters { proposition: PropositionId::new(0) }));
    let schema = Schema { propositions: &[], ..NO_PLACES };
    assert_eq!(found(Cart { schema, ..Cart::default() }), Err(DomainFlaw::Attribute { attribute: 0 }));
    let schema = Schema { propositions: &[], attributes: &[], ..NO_PLACES };
    assert_eq!(found(Cart { schema, ..Cart::default() }), Err(DomainFlaw::ObjectClass { object: ObjectId::new(1) }));
}

#[test]
fn a_value_that_no_word_could_speak_of_is_found() {
    let objects: Vec<(ClassId, &str, &[&str])> = vec![(CART, "cart0", &["red"]), (PLACE, "place0", &["red"])];
    assert_eq!(found(Cart { objects, ..Cart::default() }), Err(DomainFlaw::Value { object: ObjectId::new(0), attribute: 0 }));
}

#[test]
fn a_task_that_is_given_twice_is_refused_with_both_positions() {
    let task = || LiftedTask::parse("cartAtPlace(?c, ?p)", &SOUND).unwrap();
    let refused = Agent::new(HeapMemory::new(&goodbot::Capacities::SMALL).agent, &[task(), task()], Options::DEFAULT).unwrap_err();
    assert_eq!(refused, AgentError::SameTask { first: 0, second: 1 });
}
