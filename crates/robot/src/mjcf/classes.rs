use std::collections::BTreeMap;

use crate::error::RobotError;
use crate::mjcf::element::Element;

/// Name of the class that every element is of unless it says another.
pub const MAIN: &str = "main";

/// Attributes by the name of the element and that of the attribute.
type Attributes = BTreeMap<(String, String), String>;

/// `<default>`: attributes of elements that do not say them, by class.
#[derive(Debug, Default)]
pub struct Classes {
    attributes: BTreeMap<String, Attributes>,
}

impl Classes {
    /// The classes of a file.
    ///
    /// # Errors
    ///
    /// [`RobotError::BadElement`] for a class inside of another that has no name.
    pub fn new(root: &Element) -> Result<Self, RobotError> {
        let mut classes = Self::default();
        classes.attributes.insert(MAIN.to_owned(), Attributes::new());
        for element in root.all("default") {
            let name = element.get("class").unwrap_or(MAIN).to_owned();
            let known = classes.attributes.get(MAIN).cloned().unwrap_or_default();
            classes.learn(element, name, known)?;
        }
        Ok(classes)
    }

    fn learn(
        &mut self,
        element: &Element,
        name: String,
        mut attributes: Attributes,
    ) -> Result<(), RobotError> {
        for child in element.children.iter().filter(|child| child.name != "default") {
            for (key, value) in &child.attributes {
                attributes.insert((child.name.clone(), key.clone()), value.clone());
            }
        }
        self.attributes.insert(name, attributes.clone());
        for child in element.all("default") {
            let name = child.get("class").ok_or_else(|| child.bad("it has no class"))?;
            self.learn(child, name.to_owned(), attributes.clone())?;
        }
        Ok(())
    }

    /// Whether there is a class of this name.
    pub fn has(&self, class: &str) -> bool {
        self.attributes.contains_key(class)
    }

    /// An attribute of an element: its own, or that of its class, or of the one around it.
    pub fn get<'a>(&'a self, element: &'a Element, around: &str, key: &str) -> Option<&'a str> {
        let class = element.get("class").unwrap_or(around);
        let of_class = || {
            let attributes = self.attributes.get(class)?;
            attributes.get(&(element.name.clone(), key.to_owned())).map(String::as_str)
        };
        element.get(key).or_else(of_class)
    }
}
