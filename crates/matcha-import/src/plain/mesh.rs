//! A glTF mesh: its primitives merged into one mesh with material slots.

use super::material::VERTEX_COLOR;
use super::names::Names;
use super::z_up;
use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::report::{Report, ReportKind};
use crate::tangent::flat_normal;
use glam::{Vec2, Vec3, Vec4};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked as Valid;
use matcha_render::scene::{Mesh, MeshAttribute, UvSet};
use std::collections::{BTreeMap, HashMap};

/// Positions further out than this overflow when squared and multiplied (metres).
const FAR: f32 = 1e12;

/// How the attributes of a mesh are called, and where their names are collected.
pub(crate) struct Naming<'n> {
    pub uv: &'n mut Names,
    pub attributes: &'n mut Names,
    /// What the file itself says; none: the semantics are the names.
    pub known: Option<&'n Known>,
}

/// What an extension says about a mesh's layers and slots.
pub(crate) struct Known {
    /// Names by semantic (`TEXCOORD_0`, `COLOR_1`, `_DIRT`); others are left out.
    pub names: BTreeMap<String, String>,
    /// Slot of each primitive.
    pub slots: Vec<u16>,
    /// The semantic of Generated coordinates.
    pub generated: Option<String>,
    /// Semantic of Random Per Island.
    pub island: Option<String>,
}

impl Naming<'_> {
    fn name(&self, semantic: &str) -> Option<String> {
        match self.known {
            Some(known) => known.names.get(semantic).cloned(),
            None => Some(semantic.to_owned()),
        }
    }

    fn is_island(&self, semantic: &str) -> bool {
        self.known
            .is_some_and(|known| known.island.as_deref() == Some(semantic))
    }

    fn is_generated(&self, semantic: &str) -> bool {
        self.known
            .is_some_and(|known| known.generated.as_deref() == Some(semantic))
    }
}

pub(crate) struct MeshBuilder {
    /// The mesh, whose `material_slots` are left to be filled from `slot_keys`.
    pub mesh: Mesh,
    /// glTF material of each slot.
    pub slot_keys: Vec<Option<usize>>,
    /// True if a primitive has `COLOR_0`.
    pub colored: bool,
    uv: BTreeMap<String, Vec<[Vec2; 3]>>,
    attributes: BTreeMap<String, Vec<[Vec4; 3]>>,
    smooth: bool,
    slot_of_key: HashMap<Option<usize>, usize>,
    base_of_positions: HashMap<usize, (u32, usize)>,
    place: String,
    zero_area: u64,
    not_finite: u64,
}

impl MeshBuilder {
    /// Reads all primitives of mesh `index`.
    pub fn build(
        document: &Document<'_>,
        index: usize,
        mut naming: Naming<'_>,
        report: &mut Report,
    ) -> Checked<MeshBuilder> {
        let source = &document.root.meshes[index];
        let mut builder = MeshBuilder {
            mesh: Mesh {
                name: source.name.clone().unwrap_or_default(),
                ..Mesh::default()
            },
            slot_keys: Vec::new(),
            colored: false,
            uv: BTreeMap::new(),
            attributes: BTreeMap::new(),
            smooth: false,
            slot_of_key: HashMap::new(),
            base_of_positions: HashMap::new(),
            place: format!("meshes[{index}]"),
            zero_area: 0,
            not_finite: 0,
        };
        if source
            .weights
            .as_ref()
            .is_some_and(|weights| weights.iter().any(|w| *w != 0.0))
        {
            let what = ReportKind::Feature("morph targets are not supported".into());
            report.add(
                what,
                &format!("mesh \"{}\"", builder.mesh.name),
                "rendered without them",
            );
        }
        for (p, primitive) in source.primitives.iter().enumerate() {
            builder.primitive(document, primitive, p, &naming, report)?;
        }
        builder.finish(&mut naming, report)?;
        Ok(builder)
    }

    fn primitive(
        &mut self,
        document: &Document<'_>,
        primitive: &Primitive,
        number: usize,
        naming: &Naming<'_>,
        report: &mut Report,
    ) -> Checked<()> {
        let place = format!("{}.primitives[{number}]", self.place);
        let (Valid::Valid(mode), Some(positions)) = (
            primitive.mode,
            primitive.attributes.get(&Valid::Valid(Semantic::Positions)),
        ) else {
            return Err(Fault::new(place, "has no positions"));
        };
        if !matches!(
            mode,
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
        ) {
            report.add(
                ReportKind::Feature("points and lines are not supported".into()),
                &place,
                "left out",
            );
            return Ok(());
        }
        let (base, vertices) = self.positions(document, positions.value(), &place)?;
        let order = match primitive.indices {
            Some(indices) => document.indices(indices.value(), vertices)?,
            None => {
                document.budget.charge(4 * vertices as u64, &place)?;
                (0..vertices as u32).collect()
            }
        };
        document
            .budget
            .charge(triangle_count(mode, order.len()) as u64 * 12, &place)?;
        let triangles = self.keep_with_area(base, triangles(mode, &order));
        let first = self.mesh.indices.len();
        self.mesh
            .indices
            .extend(triangles.iter().map(|t| t.map(|i| i + base)));
        let slot = match naming
            .known
            .map(|known| known.slots.get(number).copied().unwrap_or(0))
        {
            Some(slot) => slot,
            None => self.slot(primitive.material.map(|m| m.value()), &place)?,
        };
        self.mesh.slots.resize(self.mesh.indices.len(), slot);
        self.corners(
            document,
            primitive,
            Run {
                first,
                triangles: &triangles,
                vertices,
                place: &place,
            },
            naming,
        )
    }

    /// Appends positions, once for primitives that share them: first vertex and count.
    fn positions(
        &mut self,
        document: &Document<'_>,
        accessor: usize,
        place: &str,
    ) -> Checked<(u32, usize)> {
        if let Some(&known) = self.base_of_positions.get(&accessor) {
            return Ok(known);
        }
        let raw = document.floats::<3>(accessor, "positions")?;
        let base = u32::try_from(self.mesh.positions.len() + raw.len())
            .map(|end| end - raw.len() as u32)
            .map_err(|_| Fault::new(place, "the mesh has more than 4,294,967,295 vertices"))?;
        for (v, position) in raw.iter().enumerate() {
            if !position.iter().all(|x| x.abs() <= FAR) {
                let [x, y, z] = position;
                let problem = format!(
                    "the position of vertex {v} is ({x}, {y}, {z}), not finite or beyond {FAR:e} m"
                );
                return Err(Fault::new(place, problem));
            }
        }
        self.mesh
            .positions
            .extend(raw.iter().map(|&p| z_up(Vec3::from_array(p))));
        self.base_of_positions.insert(accessor, (base, raw.len()));
        Ok((base, raw.len()))
    }

    fn keep_with_area(&mut self, base: u32, mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
        let before = triangles.len();
        let positions = &self.mesh.positions;
        triangles.retain(|t| {
            let [a, b, c] = t.map(|i| positions[(i + base) as usize].as_dvec3());
            (b - a).cross(c - a).length() > 0.0
        });
        self.zero_area += (before - triangles.len()) as u64;
        triangles
    }

    fn slot(&mut self, material: Option<usize>, place: &str) -> Checked<u16> {
        let slot = *self.slot_of_key.entry(material).or_insert_with(|| {
            self.slot_keys.push(material);
            self.slot_keys.len() - 1
        });
        u16::try_from(slot)
            .map_err(|_| Fault::new(place, "the mesh has more than 65,536 materials"))
    }

    /// Normals, texture coordinates, colours and other attributes of new triangles.
    fn corners(
        &mut self,
        document: &Document<'_>,
        primitive: &Primitive,
        run: Run<'_>,
        naming: &Naming<'_>,
    ) -> Checked<()> {
        for (semantic, accessor) in &primitive.attributes {
            let Valid::Valid(semantic) = semantic else {
                continue;
            };
            let (name, accessor) = (semantic.to_string(), accessor.value());
            match semantic {
                Semantic::Normals => self.normals(document, accessor, &run)?,
                Semantic::TexCoords(_) => {
                    let Some(name) = naming.name(&name) else {
                        continue;
                    };
                    let values =
                        vertex_values::<2>(document, accessor, &run, "texture coordinates")?;
                    let list = self.uv.entry(name).or_default();
                    list.resize(run.first, [Vec2::ZERO; 3]);
                    let not_finite = &mut self.not_finite;
                    list.extend(run.triangles.iter().map(|t| {
                        t.map(|i| {
                            let [u, v] = values[i as usize];
                            finite(
                                Vec2::new(u, 1.0 - v),
                                Vec2::is_finite,
                                Vec2::ZERO,
                                not_finite,
                            )
                        })
                    }));
                }
                Semantic::Extras(_) if naming.is_generated(&name) => {
                    self.generated(document, accessor, &run)?;
                }
                Semantic::Extras(_) if naming.is_island(&name) => {
                    self.islands(document, accessor, &run)?;
                }
                Semantic::Colors(_) | Semantic::Extras(_) => {
                    self.colored |= name == VERTEX_COLOR;
                    let Some(name) = naming.name(&name) else {
                        continue;
                    };
                    let values = four_wide(document, accessor, &run)?;
                    let list = self.attributes.entry(name).or_default();
                    list.resize(run.first, [Vec4::ZERO; 3]);
                    let not_finite = &mut self.not_finite;
                    list.extend(run.triangles.iter().map(|t| {
                        t.map(|i| {
                            finite(values[i as usize], Vec4::is_finite, Vec4::ZERO, not_finite)
                        })
                    }));
                }
                Semantic::Positions
                | Semantic::Tangents
                | Semantic::Joints(_)
                | Semantic::Weights(_) => {}
            }
        }
        Ok(())
    }

    fn normals(&mut self, document: &Document<'_>, accessor: usize, run: &Run<'_>) -> Checked<()> {
        let values = vertex_values::<3>(document, accessor, run, "normals")?;
        self.smooth = true;
        self.fill_flat(run.first);
        for (k, triangle) in run.triangles.iter().enumerate() {
            let corners = triangle.map(|i| {
                z_up(Vec3::from_array(values[i as usize]))
                    .try_normalize()
                    .unwrap_or_else(|| {
                        self.not_finite += 1;
                        flat_normal(&self.mesh, run.first + k)
                    })
            });
            self.mesh.corner_normals.push(corners);
        }
        Ok(())
    }

    /// Generated coordinates; they are in Blender's axes already.
    fn generated(
        &mut self,
        document: &Document<'_>,
        accessor: usize,
        run: &Run<'_>,
    ) -> Checked<()> {
        let values = vertex_values::<3>(document, accessor, run, "generated coordinates")?;
        self.mesh.generated.resize(run.first, [Vec3::ZERO; 3]);
        for triangle in run.triangles {
            let corner = |i: u32| Vec3::from_array(values[i as usize]);
            let corners = triangle
                .map(|i| finite(corner(i), Vec3::is_finite, Vec3::ZERO, &mut self.not_finite));
            self.mesh.generated.push(corners);
        }
        Ok(())
    }

    fn islands(&mut self, document: &Document<'_>, accessor: usize, run: &Run<'_>) -> Checked<()> {
        let values = vertex_values::<1>(document, accessor, run, "random numbers of islands")?;
        self.mesh.islands.resize(run.first, 0.0);
        for triangle in run.triangles {
            let [value] = values[triangle[0] as usize];
            let value = finite(value, f32::is_finite, 0.0, &mut self.not_finite);
            self.mesh.islands.push(value);
        }
        Ok(())
    }

    /// Flat normals for the triangles before `end` that have none.
    fn fill_flat(&mut self, end: usize) {
        for face in self.mesh.corner_normals.len()..end {
            self.mesh
                .corner_normals
                .push([flat_normal(&self.mesh, face); 3]);
        }
    }

    fn finish(&mut self, naming: &mut Naming<'_>, report: &mut Report) -> Checked<()> {
        let total = self.mesh.indices.len();
        if self.smooth {
            self.fill_flat(total);
        }
        for (name, mut corners) in std::mem::take(&mut self.uv) {
            corners.resize(total, [Vec2::ZERO; 3]);
            let name = naming.uv.intern(&name)?;
            self.mesh.uv_sets.push(UvSet {
                name,
                corners,
                tangents: Vec::new(),
            });
        }
        for (name, mut corners) in std::mem::take(&mut self.attributes) {
            corners.resize(total, [Vec4::ZERO; 3]);
            self.mesh.attributes.push(MeshAttribute {
                name: naming.attributes.intern(&name)?,
                corners,
            });
        }
        if !self.mesh.generated.is_empty() {
            self.mesh.generated.resize(total, [Vec3::ZERO; 3]);
        }
        if !self.mesh.islands.is_empty() {
            self.mesh.islands.resize(total, 0.0);
        }
        if self.mesh.slots.iter().all(|&slot| slot == 0) {
            self.mesh.slots = Vec::new();
        }
        (self.mesh.generated_origin, self.mesh.generated_size) = bounds(&self.mesh.positions);
        let subject = format!("mesh \"{}\"", self.mesh.name);
        let zero_area = ReportKind::Note("triangles without area".into());
        report.add_many(zero_area, &subject, "left out", self.zero_area);
        let not_finite =
            ReportKind::Note("normals, coordinates or colours that are zero or not finite".into());
        report.add_many(
            not_finite,
            &subject,
            "flat normals or zeros in their place",
            self.not_finite,
        );
        Ok(())
    }
}

/// The triangles that a primitive adds.
struct Run<'r> {
    /// Number of the first one in the mesh.
    first: usize,
    /// Their vertices, counted within the primitive.
    triangles: &'r [[u32; 3]],
    /// Number of the primitive's vertices.
    vertices: usize,
    place: &'r str,
}

fn vertex_values<const N: usize>(
    document: &Document<'_>,
    accessor: usize,
    run: &Run<'_>,
    use_: &str,
) -> Checked<Vec<[f32; N]>> {
    let values = document.floats::<N>(accessor, use_)?;
    if values.len() < run.vertices {
        let problem = format!("has {} {use_} for {} vertices", values.len(), run.vertices);
        return Err(Fault::new(run.place, problem));
    }
    document
        .budget
        .charge(run.triangles.len() as u64 * 12 * N as u64, run.place)?;
    Ok(values)
}

/// A colour or attribute of one to four components; what is missing is grey, z = 0, w = 1.
fn four_wide(document: &Document<'_>, accessor: usize, run: &Run<'_>) -> Checked<Vec<Vec4>> {
    let use_ = "colours or attributes";
    document
        .budget
        .charge(run.triangles.len() as u64 * 48, run.place)?;
    Ok(match document.shape(accessor)?.1 {
        1 => vertex_values::<1>(document, accessor, run, use_)?
            .iter()
            .map(|[x]| Vec3::splat(*x).extend(1.0))
            .collect(),
        2 => vertex_values::<2>(document, accessor, run, use_)?
            .iter()
            .map(|[x, y]| Vec4::new(*x, *y, 0.0, 1.0))
            .collect(),
        3 => vertex_values::<3>(document, accessor, run, use_)?
            .iter()
            .map(|&v| Vec3::from_array(v).extend(1.0))
            .collect(),
        _ => vertex_values::<4>(document, accessor, run, use_)?
            .iter()
            .map(|&v| Vec4::from_array(v))
            .collect(),
    })
}

fn finite<V: Copy>(value: V, is_finite: fn(V) -> bool, zero: V, bad: &mut u64) -> V {
    if is_finite(value) {
        return value;
    }
    *bad += 1;
    zero
}

fn triangle_count(mode: Mode, order: usize) -> usize {
    if mode == Mode::Triangles {
        order / 3
    } else {
        order.saturating_sub(2)
    }
}

/// Triangles of a list, strip or fan (glTF 2.0, section 3.7.2.1); left-over indices are none.
fn triangles(mode: Mode, order: &[u32]) -> Vec<[u32; 3]> {
    let count = triangle_count(mode, order.len());
    match mode {
        Mode::TriangleStrip => (0..count)
            .map(|i| [order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]])
            .collect(),
        Mode::TriangleFan => (0..count)
            .map(|i| [order[i + 1], order[i + 2], order[0]])
            .collect(),
        _ => order.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}

/// Corner and size of the bounding box; a side of nothing counts as 1 so that it divides.
fn bounds(positions: &[Vec3]) -> (Vec3, Vec3) {
    let Some(&first) = positions.first() else {
        return (Vec3::ZERO, Vec3::ONE);
    };
    let (low, high) = positions
        .iter()
        .fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)));
    let size = high - low;
    (low, Vec3::select(size.cmpgt(Vec3::ZERO), size, Vec3::ONE))
}
