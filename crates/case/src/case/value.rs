//! Strict reading of a value: only the types and ranges that its key admits ([`keys`]).

use std::borrow::Cow;

use super::error::Refusal;
use super::keys::{self, Form, Key, Keys};
use super::node::{Node, Value};
use super::suggestions::{alternatives, nearest};
use percoat_common::plain;

/// A value of the case with its path, such as `layers[0].poisson`, its key and the forms it may have.
#[derive(Debug)]
pub(super) struct ValueAt<'a> {
    pub(super) node: Cow<'a, Node>,
    pub(super) key: &'static Key,
    pub(super) forms: &'static [Form],
    /// The keys of the whole case.
    pub(super) all: &'static Keys,
    pub(super) path: String,
}

impl<'a> ValueAt<'a> {
    pub(super) fn new(node: Cow<'a, Node>, key: &'static Key, all: &'static Keys, path: String) -> Self {
        Self { node, key, forms: key.forms, all, path }
    }

    /// Refusal of the value: "`path` must be `wanted`, not …".
    pub(super) fn refuse(&self, wanted: impl std::fmt::Display) -> Refusal {
        let received = self.node.value.describe();
        let message = format!("`{}` must be {wanted}, not {received}", self.path);
        Refusal::new(self.node.span, message, format!("received {received}"))
    }

    /// Refusal of a value that has none of the forms of its key.
    pub(super) fn refuse_form(&self) -> Refusal {
        self.refuse(keys::requirement(self.forms))
    }

    /// Refusal of a value that has none of the forms of its key, with an example.
    fn refuse_with_example(&self) -> Refusal {
        self.refuse_form().help(self.example())
    }

    /// An example, as in "for example planes = [0.0, 0.5]".
    pub(super) fn example(&self) -> String {
        format!("for example {} = {}", self.key.name, self.key.example)
    }

    /// A number that the key admits; integers count as numbers.
    pub(super) fn number(&self) -> Result<f64, Refusal> {
        let value = match self.node.value {
            // Exact up to 2⁵³, else the nearest float as for any decimal.
            Value::Integer(value) => value as f64,
            Value::Float(value) => value,
            _ => return Err(self.refuse_form()),
        };
        let range = self.forms.iter().find_map(|form| if let Form::Number(range) = form { Some(range) } else { None });
        range.ok_or_else(|| self.refuse_form())?.admit(value).map_err(|beyond| {
            let refusal = self.refuse(beyond.wanted);
            beyond.help.into_iter().fold(refusal, Refusal::help)
        })
    }

    /// An integer that the key admits.
    pub(super) fn integer(&self) -> Result<usize, Refusal> {
        let form = self.forms.iter().find(|form| matches!(form, Form::Integer(..)));
        let Some(Form::Integer(low, high)) = form else { return Err(self.refuse_form()) };
        if let Value::Integer(value) = self.node.value
            && let Ok(value) = usize::try_from(value)
            && (low..=high).contains(&&value)
        {
            return Ok(value);
        }
        Err(self.refuse(keys::requirement(&[Form::Integer(*low, *high)])))
    }

    /// True or false.
    pub(super) fn boolean(&self) -> Result<bool, Refusal> {
        match self.node.value {
            Value::Boolean(value) if self.forms.iter().any(|form| matches!(form, Form::Boolean)) => Ok(value),
            _ => Err(self.refuse_form()),
        }
    }

    pub(super) fn text(&self) -> Result<&str, Refusal> {
        let known = self.forms.iter().any(|form| matches!(form, Form::Text(_)));
        match &self.node.value {
            Value::Text(text) if known => Ok(text),
            _ => Err(self.refuse_form()),
        }
    }

    /// A name of no more letters than the key admits.
    pub(super) fn name(&self) -> Result<&str, Refusal> {
        let most = self.forms.iter().find_map(|form| if let Form::Name(_, most) = form { Some(*most) } else { None });
        let fits = |text: &str| {
            most.is_some_and(|most| (1..=most).contains(&text.chars().count()))
                && text.trim() == text
                && !text.contains(plain::is_hidden)
        };
        match &self.node.value {
            Value::Text(text) if fits(text) => Ok(text),
            _ => Err(self.refuse(format!("{}, such as {}", keys::requirement(self.forms), self.key.example))),
        }
    }

    /// One of the key's words.
    pub(super) fn word(&self) -> Result<&'static str, Refusal> {
        let words = self.forms.iter().find_map(|form| if let Form::Word(words) = form { Some(*words) } else { None });
        let (Value::Text(text), Some(words)) = (&self.node.value, words) else { return Err(self.refuse_form()) };
        words.iter().find(|word| *word == text).copied().ok_or_else(|| {
            let refusal = self.refuse(alternatives(words, '"'));
            match nearest(text, words) {
                Some((near, _)) => refusal.help(format!("did you mean \"{near}\"?")),
                None => refusal,
            }
        })
    }

    /// `N` items in brackets.
    pub(super) fn tuple<const N: usize>(&self) -> Result<[ValueAt<'a>; N], Refusal> {
        let known = |form: &&'static Form| matches!(form, Form::Tuple(_, items) if items.len() == N);
        let form = self.forms.iter().find(known);
        let (Value::List(_), Some(Form::Tuple(_, forms))) = (&self.node.value, form) else {
            return Err(self.refuse_with_example());
        };
        let items: Vec<ValueAt<'a>> = self.each(forms).collect();
        items.try_into().map_err(|_| self.refuse_with_example())
    }

    /// `N` numbers in brackets.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N], Refusal> {
        let mut numbers = [0.0; N];
        for (number, item) in numbers.iter_mut().zip(self.tuple::<N>()?) {
            *number = item.number()?;
        }
        Ok(numbers)
    }

    /// The items of a list, as many as the key admits.
    pub(super) fn list(&self) -> Result<Vec<ValueAt<'a>>, Refusal> {
        let form = self.forms.iter().find(|form| matches!(form, Form::List { .. }));
        let (Value::List(items), Some(form @ Form::List { of, count: [least, most] })) = (&self.node.value, form)
        else {
            return Err(self.refuse_with_example());
        };
        if items.len() < *least {
            return Err(self.refuse(keys::requirement(std::slice::from_ref(form))).help(self.example()));
        }
        if items.len() > *most {
            return Err(self.refuse(format!("a list of at most {most} items")));
        }
        Ok(self.each(std::slice::from_ref(*of)).collect())
    }

    /// The items of a list, of one form or each of its own.
    pub(super) fn each(&self, forms: &'static [Form]) -> impl Iterator<Item = ValueAt<'a>> {
        let nodes: Vec<Cow<'a, Node>> = match &self.node {
            Cow::Borrowed(Node { value: Value::List(items), .. }) => items.iter().map(Cow::Borrowed).collect(),
            Cow::Owned(Node { value: Value::List(items), .. }) => items.iter().cloned().map(Cow::Owned).collect(),
            _ => Vec::new(),
        };
        nodes.into_iter().enumerate().map(|(index, node)| {
            let form = if forms.len() > 1 { index.min(forms.len() - 1) } else { 0 };
            let path = format!("{}[{index}]", self.path);
            ValueAt { node, key: self.key, forms: &forms[form..=form], all: self.all, path }
        })
    }
}
