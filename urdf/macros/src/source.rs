//! The printed source, put where it is called.
//!
//! The printer writes a file of its own, with imports at its top. Here its items stand among those
//! of a user: every name of the library is a path from its root, and joints and forces that the
//! printer defines have a module of their own. So nothing is imported, and two robots can be
//! neighbours.

use holonom_urdf::Mechanism;
use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};
use syn::punctuated::Punctuated;
use syn::{
    Attribute, Field, Fields, File, ImplItem, Item, ItemImpl, ItemStruct, Meta, Token, Type,
    Visibility,
};
use syn::{parse_quote, parse_quote_spanned};

use crate::input::Input;

/// The items of a mechanism.
pub(crate) fn items(mechanism: &Mechanism, input: &Input) -> TokenStream {
    // It looks as if written by a macro, and stands at the name of the file.
    let span = Span::call_site().located_at(input.file.span());
    let printed: TokenStream = mechanism
        .to_string()
        .parse()
        .expect("the printer writes tokens");
    let file: File = syn::parse2(moved(printed, span)).expect("the printer writes items");
    let mut place = Place {
        input,
        span,
        module: format_ident!("__{}", input.name, span = span),
        defined: Vec::new(),
    };
    let (mut definitions, mut items) = (TokenStream::new(), TokenStream::new());
    for item in file.items {
        match item {
            Item::Macro(item) => {
                let (facade, tokens) = (&input.facade, &item.mac.tokens);
                let macro_name = &item.mac.path.segments.last().expect("a name").ident;
                definitions.extend(quote!(#facade::#macro_name! { #tokens }));
                place.defined.extend(defined(tokens));
            }
            Item::Struct(item) => place.structure(item).to_tokens(&mut items),
            Item::Impl(item) => place.constants(item).to_tokens(&mut items),
            // Imports: all names are paths.
            _ => {}
        }
    }
    let module = place.module(&definitions);
    quote!(#module #items)
}

/// Where the items stand.
struct Place<'a> {
    input: &'a Input,
    span: Span,
    /// The module of what the printer defines.
    module: Ident,
    /// Names in that module.
    defined: Vec<Ident>,
}

impl Place<'_> {
    fn module(&self, definitions: &TokenStream) -> Option<TokenStream> {
        let (module, visibility) = (&self.module, &self.input.visibility);
        (!self.defined.is_empty()).then(|| {
            quote! {
                #[doc(hidden)]
                #[allow(non_snake_case, unreachable_pub)]
                #visibility mod #module { #definitions }
            }
        })
    }

    fn structure(&self, mut item: ItemStruct) -> ItemStruct {
        let input = self.input;
        item.ident = input.name.clone();
        item.vis = input.visibility.clone();
        let printed = std::mem::take(&mut item.attrs);
        // The words of the user come first, and the derive before what it reads.
        let (docs, mut others) = input
            .attributes
            .iter()
            .cloned()
            .partition::<Vec<_>, _>(|one| one.path().is_ident("doc"));
        let mut own = others.iter_mut().filter(|one| is_of_mechanism(one));
        let mut own = own.next();
        item.attrs = docs;
        if !item.attrs.is_empty() {
            item.attrs.push(parse_quote!(#[doc = ""]));
        }
        for attribute in printed {
            if attribute.path().is_ident("derive") {
                item.attrs.push(self.derives());
            } else if let (true, Some(own)) = (is_of_mechanism(&attribute), &mut own) {
                add_settings(own, &attribute);
            } else {
                item.attrs.push(attribute);
            }
        }
        item.attrs.extend(others);
        let Fields::Named(fields) = &mut item.fields else {
            return item;
        };
        for field in &mut fields.named {
            self.field(field);
        }
        fields.named.extend(input.fields.iter().cloned());
        item
    }

    /// What the printer derives, by paths.
    fn derives(&self) -> Attribute {
        let facade = &self.input.facade;
        parse_quote_spanned! {self.span=>
            #[derive(
                ::core::clone::Clone,
                ::core::marker::Copy,
                ::core::fmt::Debug,
                #facade::prelude::Mechanism
            )]
        }
    }

    fn field(&self, field: &mut Field) {
        self.reach(&mut field.vis);
        let Type::Path(path) = &field.ty else { return };
        let Some(name) = path.path.get_ident() else {
            return;
        };
        let (module, facade) = (&self.module, &self.input.facade);
        if name == "f64" {
            return;
        }
        field.ty = if self.defined.contains(name) {
            parse_quote!(#module::#name)
        } else {
            parse_quote!(#facade::prelude::#name)
        };
    }

    fn constants(&self, mut item: ItemImpl) -> ItemImpl {
        let name = &self.input.name;
        *item.self_ty = parse_quote!(#name);
        for one in &mut item.items {
            if let ImplItem::Const(constant) = one {
                self.reach(&mut constant.vis);
            }
        }
        item
    }

    /// What the printer makes public is so as far as the struct is.
    fn reach(&self, visibility: &mut Visibility) {
        if matches!(visibility, Visibility::Public(_)) {
            *visibility = self.input.visibility.clone();
        }
    }
}

fn is_of_mechanism(attribute: &Attribute) -> bool {
    attribute.path().is_ident("mechanism")
}

/// Adds the settings of a printed `#[mechanism(..)]` that the user's one does not name.
fn add_settings(own: &mut Attribute, printed: &Attribute) {
    let settings = Punctuated::<Meta, Token![,]>::parse_terminated;
    let printed = printed.parse_args_with(settings);
    let printed = printed.expect("the printer writes settings");
    // Of another form than a list it is refused by the derive.
    let Meta::List(list) = &mut own.meta else {
        return;
    };
    let tokens = Vec::from_iter(list.tokens.clone());
    let names =
        tokens.split(|token| matches!(token, TokenTree::Punct(one) if one.as_char() == ','));
    let names = names.filter_map(|setting| setting.first());
    let named: Vec<String> = names.map(ToString::to_string).collect();
    let is_left = |one: &&Meta| named.iter().all(|name| !one.path().is_ident(name));
    let others = printed.iter().filter(is_left);
    let own = &list.tokens;
    let comma = tokens.last().is_some_and(|last| last.to_string() != ",");
    let comma = comma.then(|| quote!(,));
    list.tokens = quote!(#own #comma #(#others),*);
}

/// The name in `pub joint Name(..)`.
fn defined(tokens: &TokenStream) -> Option<Ident> {
    let names = tokens.clone().into_iter().filter_map(|token| match token {
        TokenTree::Ident(name) => Some(name),
        _ => None,
    });
    names.into_iter().nth(2)
}

/// The same tokens at another place.
fn moved(tokens: TokenStream, span: Span) -> TokenStream {
    let all = tokens.into_iter().map(|token| {
        let mut token = match token {
            TokenTree::Group(group) => {
                Group::new(group.delimiter(), moved(group.stream(), span)).into()
            }
            other => other,
        };
        token.set_span(span);
        token
    });
    all.collect()
}
