// Walks the hierarchy: the only trace site of a kernel. It stops at a budget of steps and can go on in a later dispatch,
// because some drivers silently end loops that run long (docs/architecture.md).

/// A ray on its way: what is left to visit and the best hit so far.
struct Traversal {
    vec3 origin;
    vec3 direction;
    bool anyHit;  // any occluder will do
    uint node;    // next to visit; NODE_NONE when done
    NodeStack stack;
    float t;      // of the best hit, or the end of the ray
    uint slot;    // of the best hit, or MINIRT_NONE
};

Traversal beginTraversal(vec3 origin, vec3 direction, float tMax, bool anyHit) {
    return Traversal(origin, direction, anyHit, 0u, stackInMemory(0), tMax, MINIRT_NONE);
}

/// No ray: done from the start.
Traversal noRay() {
    Traversal none = beginTraversal(vec3(0.0), vec3(0.0, 0.0, 1.0), 0.0, true);
    none.node = NODE_NONE;
    return none;
}

bool isDone(Traversal traversal) { return traversal.node == NODE_NONE; }

/// What a pass of an inner loop counts: a GPU's driver ends no loop, so there those of the outer one will do, which the inner ones cannot outlast.
const uint PASS = MASKS_LANES ? 1u : 0u;

/// Nodes that a GPU's lane visits before it looks whether it has a leaf to test: without a limit all lanes of a subgroup wait for the longest way to a
/// leaf. Where lanes are masked they wait anyway, and another look costs.
const uint NODES_TOGETHER = 4u;

/// All primitives of a leaf.
void intersectLeaf(inout Traversal ray, Shear shear, uint leaf, inout uint steps) {
    uint slot = (leaf & ~MINIRT_LEAF) >> 3;
    uint end = slot + (leaf & 7u) + 1u;
    do {
        steps += PASS;
        countTriangleTest();
        PrimitiveHit found = intersectPrimitive(slot, ray.origin, ray.direction, shear, ray.t);
        ray.t = found.hit ? found.t : ray.t;
        ray.slot = found.hit ? slot : ray.slot;
        slot++;
    } while (slot < end);
}

/// Visits nodes until the ray is done or `steps` reaches `budget`. Counts a step for every pass of every loop, as some drivers do. Loops test
/// at their end: where a driver masks lanes, a pass that only finds the condition false costs as much as any other.
void traverse(inout Traversal ray, inout uint steps, uint budget) {
    BoxRay boxRay = boxRayOf(slabRay(ray.origin, ray.direction, scene.gridOrigin.xyz, scene.gridScale.xyz, scene.gridPlanes.xyz));
    Shear shear = shearOf(ray.direction);
    uint node = ray.node;
    NodeStack stack = ray.stack;
    if (node != NODE_NONE) {  // a ray that is done takes one step, so that whoever waits for it gets on under any budget
        do {
            countNodeBranch((node & MINIRT_LEAF) == 0u);
            if ((node & MINIRT_LEAF) == 0u) {
                uint nodes = 0u;
                do {
                    steps += PASS;
                    countNodeStep();
                    Children children = fetchNode(node);
                    BoxHit hit0 = meetBox(boxRay, children.box0, ray.t);
                    BoxHit hit1 = meetBox(boxRay, children.box1, ray.t);
                    bool secondFirst = hit1.hit && (hit1.tNear < hit0.tNear || !hit0.hit);
                    node = secondFirst ? children.ref1 : children.ref0;
                    changeStack(stack, node, hit0.hit && hit1.hit, secondFirst ? children.ref0 : children.ref1, !(hit0.hit || hit1.hit));
                } while ((node & MINIRT_LEAF) == 0u && (MASKS_LANES ? steps < budget : ++nodes < NODES_TOGETHER));
            }
            countLeafBranch(node != NODE_NONE && (node & MINIRT_LEAF) != 0u);
            if (node != NODE_NONE && (node & MINIRT_LEAF) != 0u) {
                do {
                    countLeaf();
                    intersectLeaf(ray, shear, node, steps);
                    changeStack(stack, node, false, NODE_NONE, true);
                    if (ray.anyHit && ray.slot != MINIRT_NONE) node = NODE_NONE;
                    steps += PASS;
                } while (MASKS_LANES && node != NODE_NONE && (node & MINIRT_LEAF) != 0u && steps < budget);
            }
            // This pass, and those of the loops inside where all lanes of a subgroup are masked; at the end, so that any budget makes progress.
            steps += 4u;
        } while (node != NODE_NONE && steps < budget);
    }
    steps++;
    ray.node = node;
    ray.stack = stack;
}
