//! The layout of each struct, as assertions for the C compiler: another size of `bool`, packed structs or a header of another version are
//! then an error when a program is compiled, not wrong numbers when it runs.
//!
//! Every struct here has Rust's `repr(C)`, whose layout follows from its fields: each begins at the next multiple of its alignment. It depends
//! on the machine only by the size of a pointer, so there are two numbers, for 4 bytes and for 8.

use std::collections::BTreeMap;
use std::fmt::Write;

use anyhow::{Context, Result, bail};

/// A struct of the header.
#[derive(Debug, PartialEq, Eq)]
pub struct Struct {
    /// The name in C.
    pub name: String,
    /// Each field and where it begins, with pointers of 4 and of 8 bytes.
    pub fields: Vec<(String, [usize; 2])>,
    /// Its size.
    pub size: [usize; 2],
    alignment: [usize; 2],
}

/// All structs that a header describes, in its order.
pub fn structs(header: &str) -> Result<Vec<Struct>> {
    let defined = header.lines().filter_map(|line| line.strip_prefix("#define ")?.split_once(' '));
    let numbers: BTreeMap<&str, usize> = defined.filter_map(|(name, value)| Some((name, value.parse().ok()?))).collect();
    // `typedef int32_t goodbot_status;` and `typedef bool (*goodbot_pause)(void *context);`.
    let renamed = header.lines().filter_map(|line| line.strip_prefix("typedef ")?.strip_suffix(';')?.split_once(' '));
    let numbers_of_enums = renamed.filter_map(|(number, name)| Some((name, width(number)?)));
    let functions = header.lines().filter_map(|line| line.strip_prefix("typedef ")?.split_once("(*")?.1.split_once(')'));
    let kinds: BTreeMap<&str, [usize; 2]> = numbers_of_enums.chain(functions.map(|(name, _)| (name, POINTER))).collect();
    let mut found: Vec<Struct> = Vec::new();
    let mut lines = header.lines();
    while let Some(line) = lines.next() {
        let Some(name) = line.strip_prefix("typedef struct ").and_then(|rest| rest.strip_suffix(" {")) else { continue };
        let mut made = Struct { name: name.to_owned(), fields: Vec::new(), size: [0; 2], alignment: [1; 2] };
        for field in lines.by_ref().map(str::trim).take_while(|line| !line.starts_with('}')).filter(|line| !line.starts_with("//")) {
            let field = field.strip_suffix(';').with_context(|| format!("{name}: {field:?} is no whole field"))?;
            let (field, size, alignment) =
                of_field(field, &numbers, &kinds, &found).with_context(|| format!("{name}: the size of {field:?}"))?;
            let at = [0, 1].map(|width| made.size[width].next_multiple_of(alignment[width]));
            made.fields.push((field.to_owned(), at));
            for width in [0, 1] {
                made.size[width] = at[width] + size[width];
                made.alignment[width] = made.alignment[width].max(alignment[width]);
            }
        }
        made.size = [0, 1].map(|width| made.size[width].next_multiple_of(made.alignment[width]));
        found.push(made);
    }
    Ok(found)
}

const POINTER: [usize; 2] = [4, 8];

/// The bytes of one of C's own types, which are also its alignment.
fn width(kind: &str) -> Option<[usize; 2]> {
    Some(match kind {
        "bool" | "uint8_t" => [1; 2],
        "uint16_t" => [2; 2],
        "uint32_t" | "int32_t" | "float" => [4; 2],
        "uint64_t" => [8; 2],
        "size_t" => POINTER,
        _ => return None,
    })
}

/// The name of a field, its size and its alignment.
fn of_field<'h>(
    field: &'h str,
    numbers: &BTreeMap<&str, usize>,
    kinds: &BTreeMap<&str, [usize; 2]>,
    known: &[Struct],
) -> Result<(&'h str, [usize; 2], [usize; 2])> {
    if let Some((_, function)) = field.split_once("(*") {
        let (name, _) = function.split_once(')').context("a function pointer has a name")?;
        return Ok((name, POINTER, POINTER));
    }
    let (declared, lengths) = field.split_at(field.find('[').unwrap_or(field.len()));
    let (kind, name) = declared.rsplit_once([' ', '*']).context("a field has a type and a name")?;
    let count = lengths
        .split(['[', ']'])
        .filter(|length| !length.is_empty())
        .try_fold(1, |count, length| Some(count * length.parse().ok().or_else(|| numbers.get(length).copied())?));
    let count = count.context("the length of an array is a number of the header")?;
    let kind = kind.trim_start_matches("struct ");
    let number = if declared.contains('*') { Some(POINTER) } else { width(kind).or_else(|| kinds.get(kind).copied()) };
    let (size, alignment) = match (number, known.iter().find(|known| known.name == kind)) {
        (Some(number), _) => (number, number),
        (None, Some(known)) => (known.size, known.alignment),
        (None, None) => bail!("{kind} is a type without a size here"),
    };
    Ok((name, size.map(|size| size * count), alignment))
}

/// The assertions for C.
pub fn assertions(structs: &[Struct]) -> String {
    let mut text = String::from(
        "/* What the library takes for granted: a program for which it does not hold is not compiled. */\n\
         #if defined(__cplusplus)\n\
         #define GOODBOT_ASSERT(name, holds) static_assert(holds, \"goodbot: the library was compiled with another \" #name)\n\
         #elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L\n\
         #define GOODBOT_ASSERT(name, holds) _Static_assert(holds, \"goodbot: the library was compiled with another \" #name)\n\
         #else\n\
         #define GOODBOT_ASSERT(name, holds) typedef char goodbot_another_##name[(holds) ? 1 : -1]\n\
         #endif\n\
         #define GOODBOT_AT(type, field, at_32, at_64) \\\n  \
           GOODBOT_ASSERT(type##_##field, offsetof(type, field) == (sizeof(void *) == 4 ? (at_32) : (at_64)))\n\
         #define GOODBOT_SIZE(type, size_32, size_64) GOODBOT_ASSERT(type, sizeof(type) == (sizeof(void *) == 4 ? (size_32) : (size_64)))\n\
         GOODBOT_ASSERT(bool, sizeof(bool) == 1);\n\
         GOODBOT_ASSERT(pointer, sizeof(size_t) == sizeof(void *));\n",
    );
    for Struct { name, fields, size, .. } in structs {
        for (field, [at_32, at_64]) in fields {
            let _ = writeln!(text, "GOODBOT_AT({name}, {field}, {at_32}, {at_64});");
        }
        let _ = writeln!(text, "GOODBOT_SIZE({name}, {}, {});", size[0], size[1]);
    }
    text + "#undef GOODBOT_SIZE\n#undef GOODBOT_AT\n#undef GOODBOT_ASSERT\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_begins_at_a_multiple_of_its_alignment() {
        let header = "#define GOODBOT_MOST 3\n\
                      typedef uint32_t kind;\ntypedef struct one {\n  // A flag.\n  bool flag;\n  float share[GOODBOT_MOST];\n  const char *name;\n  uint8_t last[2][2];\n} one;\n\
                      typedef struct two {\n  uint8_t first;\n  struct one inner;\n  bool (*read)(void *context, uint32_t at);\n  kind last;\n} two;";
        let of = |name: &str, at| (name.to_owned(), at);
        let [one, two] = structs(header).unwrap().try_into().unwrap();
        assert_eq!(one.fields, [of("flag", [0, 0]), of("share", [4, 4]), of("name", [16, 16]), of("last", [20, 24])]);
        assert_eq!(one.size, [24, 32]);
        assert_eq!(two.fields, [of("first", [0, 0]), of("inner", [4, 8]), of("read", [28, 40]), of("last", [32, 48])]);
        assert_eq!(two.size, [36, 56]);
    }

    #[test]
    fn a_type_without_a_known_size_is_an_error() {
        let refused = structs("typedef struct one {\n  long count;\n} one;").unwrap_err();
        assert_eq!(format!("{refused:#}"), "one: the size of \"long count\": long is a type without a size here");
    }
}
